#include "emulator/devices/r2sonic/levels.h"

#include <algorithm>
#include <cmath>

namespace echoloop::r2sonic_device {
namespace {

template <class T>
void to_steps(const float* amplitude, std::size_t count, float most, T* out) {
    for (std::size_t i = 0; i < count; ++i) {
        const float steps = std::min(most, amplitude[i] * most + 0.5F);  // what is no number becomes the most
        out[i] = static_cast<T>(static_cast<std::int32_t>(steps));
    }
}

}  // namespace

std::vector<float> gain_curve(const Controls& c, const Settings& settings, const Echogram& echogram,
                              double full_scale, double brightness) {
    constexpr float octaves_per_db = 0.33219281F;  // log2(10) / 10, of power
    const auto spreading = static_cast<float>(settings.tvg ? c.spreading / 10 : 0);
    const auto per_metre = static_cast<float>(settings.tvg ? 2 * c.absorption / 1000 : 0) * octaves_per_db;
    const auto constant = static_cast<float>(2 * c.gain + brightness - full_scale) * octaves_per_db;
    std::vector<float> gain(echogram.shot.bins);
    for (std::size_t bin = 0; bin < gain.size(); ++bin) {
        const auto r = std::max(static_cast<float>(echogram.bin_range(bin)), 1.0F);
        gain[bin] = std::exp2(std::min(spreading * std::log2(r) + per_metre * r + constant, 100.0F));
    }
    return gain;
}

void amplitudes(const Echogram& echogram, std::size_t beam, const std::vector<float>& gain, float* out) {
    const float* power = echogram.beam(beam).data();
    const std::size_t bins = gain.size();
    if (echogram.rule == EchoRule::cerqueira2016) {
        std::copy_n(power, bins, out);
        return;
    }
    for (std::size_t i = 0; i < bins; ++i) out[i] = std::sqrt(power[i] * gain[i]);
}

void quantise(const float* amplitude, std::size_t count, std::uint8_t* out) {
    to_steps(amplitude, count, 255.0F, out);
}
void quantise(const float* amplitude, std::size_t count, std::uint16_t* out) {
    to_steps(amplitude, count, 65535.0F, out);
}

}  // namespace echoloop::r2sonic_device
