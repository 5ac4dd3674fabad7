#include "emulator/devices/ping360/samples.h"

#include <algorithm>
#include <cmath>

namespace echoloop::ping360 {
namespace {

std::uint8_t to_count(double value) {
    if (!(value > 0)) return 0;
    return static_cast<std::uint8_t>(std::min(255.0, std::round(value)));
}

/// Time-varied gain in dB at slant range `range`; none closer than a metre.
double tvg(double range, const Acoustics& acoustics) {
    const double r = std::max(range, 1.0);
    return acoustics.tvg_spreading * std::log10(r) + 2 * acoustics.tvg_absorption * r;
}

double shown(const Echogram& echogram, std::size_t bin, const Acoustics& a, double gain_db) {
    const float power = echogram.beam(0)[bin];
    if (echogram.rule == EchoRule::cerqueira2016) return 255 * power;
    return 255 * (level_db(power) + tvg(echogram.bin_range(bin), a) + gain_db) / a.full_scale;
}

}  // namespace

std::vector<std::uint8_t> samples_8bit(const Echogram& echogram, const Settings& settings,
                                       std::uint8_t gain) {
    const Acoustics& a = settings.acoustics;
    const double gain_db = std::min<int>(gain, 2) * a.gain_step - a.reference_level;
    std::vector<std::uint8_t> samples(echogram.shot.bins);
    for (std::size_t bin = 0; bin < samples.size(); ++bin)
        samples[bin] = to_count(shown(echogram, bin, a, gain_db));
    return samples;
}

}  // namespace echoloop::ping360
