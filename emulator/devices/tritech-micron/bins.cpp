#include "emulator/devices/tritech-micron/bins.h"

#include <algorithm>
#include <cmath>

namespace echoloop::micron {
namespace {

constexpr double full_scale_db = 80;

std::uint8_t to_count(double fraction) {
    if (!(fraction > 0)) return 0;
    return static_cast<std::uint8_t>(std::min(255.0, std::round(255 * fraction)));
}

/// Time-varied gain in dB at slant range `range`; none closer than a metre.
double tvg(double range, const Acoustics& acoustics) {
    const double r = std::max(range, 1.0);
    return acoustics.tvg_spreading * std::log10(r) + 2 * acoustics.tvg_absorption * r;
}

}  // namespace

std::vector<std::uint8_t> levels_8bit(const Echogram& echogram, const Settings& settings, std::uint8_t gain) {
    const auto beam = echogram.beam(0);
    std::vector<std::uint8_t> levels(beam.size());
    if (echogram.rule == EchoRule::cerqueira2016) {
        std::transform(beam.begin(), beam.end(), levels.begin(), [](float v) { return to_count(v); });
        return levels;
    }
    const double gain_db =
        full_scale_db * std::min<int>(gain, 210) / 210.0 - settings.acoustics.reference_level;
    for (std::size_t bin = 0; bin < beam.size(); ++bin) {
        const double shown = level_db(beam[bin]) + tvg(echogram.bin_range(bin), settings.acoustics) + gain_db;
        levels[bin] = to_count(shown / full_scale_db);
    }
    return levels;
}

std::vector<std::uint8_t> pack_4bit(const std::vector<std::uint8_t>& levels, const Settings& settings,
                                    std::uint8_t ad_low, std::uint8_t ad_span) {
    const int scale = settings.ad_span_15 ? 17 : 1;
    const int low = ad_low * scale, span = std::max(1, ad_span * scale);
    const auto nibble = [&](std::size_t bin) {
        if (bin >= levels.size()) return 0;
        return std::clamp((levels[bin] - low) * 15 / span, 0, 15);
    };
    std::vector<std::uint8_t> packed((levels.size() + 1) / 2);
    for (std::size_t i = 0; i < packed.size(); ++i) {
        const int first = nibble(2 * i), second = nibble(2 * i + 1);
        packed[i] =
            static_cast<std::uint8_t>(settings.high_nibble_first ? first << 4 | second : second << 4 | first);
    }
    return packed;
}

}  // namespace echoloop::micron
