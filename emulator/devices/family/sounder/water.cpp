#include "emulator/devices/family/sounder/water.h"

#include <algorithm>
#include <cmath>

namespace echoloop::echosounder {

bool stands_out_of_water(const Echogram& echogram, std::size_t beam, std::size_t bin, double power,
                         double margin) {
    constexpr double places[] = {0.46, 0.54, 0.62, 0.7};
    const double above = std::pow(10, margin / 10);
    if (echogram.rule != EchoRule::radiometric) return true;
    const auto levels = echogram.beam(beam);
    const double before = echogram.shot.first_bin_time / echogram.shot.bin_interval;  // bins
    const double whole = before + static_cast<double>(bin);
    const std::size_t length =
        std::min(levels.size(), static_cast<std::size_t>(std::clamp(whole / 8, 1.0, 32.0)));
    double least = power;
    for (const double place : places) {
        const double part = whole > 0 ? std::max(place, before / whole) : 1;  // the window may begin later
        const auto first = std::min(static_cast<std::size_t>(part * whole - before), levels.size() - length);
        double sum = 0;
        for (const float level : levels.subspan(first, length)) sum += level;
        const double mean = std::max(sum / static_cast<double>(length) - echogram.noise_power, 0.0);
        least = std::min(least, mean * part * part * above);
    }
    return least < power;
}

}  // namespace echoloop::echosounder
