#include "emulator/devices/tritech-profiler/echo_time.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "emulator/devices/family/tritech/bins.h"

namespace echoloop::profiler {
namespace {

constexpr double silence = -std::numeric_limits<double>::infinity();
constexpr double edge = 10;  // dB below the strongest bin, where its leading edge begins

std::uint16_t microseconds(double time) {
    return static_cast<std::uint16_t>(std::clamp(std::round(time * 1e6), 1.0, 65535.0));
}

}  // namespace

Echo find_echo(const Echogram& echogram, const EchoRule& rule, const tritech::Acoustics& acoustics,
               const tritech::Tuning& tuning) {
    const Shot& shot = echogram.shot;
    const auto start = [&](std::size_t bin) {
        return shot.first_bin_time + static_cast<double>(bin) * shot.bin_interval;
    };
    std::vector<double> levels(shot.bins, silence);
    for (std::size_t bin = 0; bin < shot.bins; ++bin)
        if (start(bin) >= rule.lockout)
            levels[bin] = tritech::shown_db(echogram, bin, acoustics, tuning, rule.gain);
    const auto peak = std::max_element(levels.begin(), levels.end());
    if (peak == levels.end() || !(*peak >= rule.threshold))
        return {0, peak == levels.end() ? silence : *peak};
    const auto at = [&](auto bin) { return static_cast<std::size_t>(bin - levels.begin()); };
    if (rule.choice == Choice::strongest)
        return {microseconds(start(at(peak)) + shot.bin_interval / 2), *peak};
    // The edge of the strongest echo lies in the run of bins before it that stay within some dB of it.
    if (rule.choice == Choice::normal) {
        auto first = peak;
        while (first != levels.begin() && *std::prev(first) >= std::max(rule.threshold, *peak - edge))
            --first;
        return {microseconds(start(at(first))), *peak};
    }
    const auto first =
        std::find_if(levels.begin(), peak, [&](double level) { return level >= rule.threshold; });
    return {microseconds(start(at(first))), *peak};
}

}  // namespace echoloop::profiler
