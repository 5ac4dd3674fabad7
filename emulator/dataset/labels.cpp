#include "emulator/dataset/labels.h"

#include <algorithm>
#include <cmath>

namespace echoloop {
namespace {

/// m/s and m: an echo from R is off by at most offset + R * per_range.
struct Shift {
    double offset, per_range;
};

Shift shift_of(const PingTruth& ping) {
    constexpr double moving = 0.003;  // of the range: 2 m/s each way, for what moves in the scene
    const Echogram& echo = ping.echo;
    const double speed = norm(ping.sonar.velocity);
    const double bins = 2 * echo.sound_speed / 2 * echo.shot.bin_interval;
    const double chirp = echo.shot.bandwidth > 0
                             ? speed * echo.shot.pulse_length * echo.shot.frequency / echo.shot.bandwidth
                             : 0;
    return {bins + chirp, speed / echo.sound_speed + (ping.movers.empty() ? 0 : moving)};
}

void keep_seen(const std::vector<BeamSight>& sights, const Echogram& echo, const Shift& shift,
               std::span<std::uint16_t> labels) {
    std::vector<std::vector<bool>> seen;  // by object, of those that are looked at
    std::vector<std::uint32_t> objects;
    const double step = echo.sound_speed / 2 * echo.shot.bin_interval,
                 first = echo.sound_speed / 2 * echo.shot.first_bin_time;
    const auto bins = static_cast<double>(labels.size());
    for (const BeamSight& sight : sights) {
        auto at = static_cast<std::size_t>(std::ranges::find(objects, sight.object) - objects.begin());
        if (at == objects.size()) objects.push_back(sight.object), seen.emplace_back(labels.size());
        const double near = sight.near * (1 - shift.per_range) - shift.offset,
                     far = sight.far * (1 + shift.per_range) + shift.offset;
        const auto begin = static_cast<std::ptrdiff_t>(std::clamp((near - first) / step, 0.0, bins)),
                   end = static_cast<std::ptrdiff_t>(std::clamp((far - first) / step + 1, 0.0, bins));
        if (begin < end) std::fill(seen[at].begin() + begin, seen[at].begin() + end, true);
    }
    for (std::size_t i = 0; i < labels.size(); ++i) {
        if (labels[i] == 0) continue;
        const auto at =
            static_cast<std::size_t>(std::ranges::find(objects, labels[i] - 1U) - objects.begin());
        if (at == objects.size() || !seen[at][i]) labels[i] = 0;
    }
}

}  // namespace

double end_range(const Echogram& echo) {
    return echo.sound_speed / 2 *
           (echo.shot.first_bin_time + static_cast<double>(echo.shot.bins) * echo.shot.bin_interval);
}

double turn_within(const PingTruth& ping) {
    return norm(ping.sonar.turning) * 2 / ping.echo.sound_speed * end_range(ping.echo);
}

void keep_main_lobes(const Look& look, PingTruth& ping) {
    Echogram& echo = ping.echo;
    const Shift shift = shift_of(ping);
    for (std::size_t beam = 0; beam < look.sights.size(); ++beam)
        keep_seen(look.sights[beam], echo, shift,
                  std::span(echo.objects).subspan(beam * echo.shot.bins, echo.shot.bins));
}

}  // namespace echoloop
