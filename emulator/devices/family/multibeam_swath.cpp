#include <algorithm>
#include <array>
#include <cmath>

#include "emulator/devices/family/multibeam_bottom.h"

namespace echoloop::multibeam {
namespace {

/// A point of the swath in seconds across and down.
struct Point {
    double across = 0, down = 0;
};

Point point_of(const Detection& detection, double angle) {
    return {detection.time * std::sin(angle), detection.time * std::cos(angle)};
}

/// Two-way time at which the beam at `angle` meets the line through two points; 0 if it does not.
double time_on_line(Point a, Point b, double angle) {
    const double x = b.across - a.across, z = b.down - a.down;
    const double facing = std::sin(angle) * z - std::cos(angle) * x;
    return facing == 0 ? 0 : (a.across * z - a.down * x) / facing;
}

}  // namespace

void mark_in_line(std::span<Detection> detections, std::span<const double> angles) {
    constexpr double tolerance = 0.02;  // of the time, own choice
    const auto count = static_cast<std::ptrdiff_t>(std::min(detections.size(), angles.size()));
    // Neighbours on either side, or two on one side: beyond a step the bottom goes on in a line, too.
    constexpr std::array<std::array<std::ptrdiff_t, 2>, 4> pairs{{{-1, 1}, {-2, 2}, {-2, -1}, {1, 2}}};
    for (std::ptrdiff_t n = 0; n < count; ++n) {
        Detection& own = detections[static_cast<std::size_t>(n)];
        const auto fits = [&](const std::array<std::ptrdiff_t, 2>& pair) {
            const std::ptrdiff_t a = n + pair[0], b = n + pair[1];
            if (a < 0 || b >= count) return false;
            const auto i = static_cast<std::size_t>(a), j = static_cast<std::size_t>(b);
            if (!detections[i].found() || !detections[j].found()) return false;
            const double expected =
                time_on_line(point_of(detections[i], angles[i]), point_of(detections[j], angles[j]),
                             angles[static_cast<std::size_t>(n)]);
            return std::abs(expected - own.time) < tolerance * own.time;
        };
        own.in_line = own.found() && std::any_of(pairs.begin(), pairs.end(), fits);
    }
}

double median_depth(std::span<const Detection> detections, std::span<const double> angles,
                    double sound_speed) {
    std::vector<double> depths;
    for (std::size_t n = 0; n < detections.size(); ++n)
        if (detections[n].found() && std::abs(angles[n]) < deg_to_rad(30))
            depths.push_back(detections[n].time * sound_speed / 2 * std::cos(angles[n]));
    if (depths.empty()) return 0;
    const auto middle = depths.begin() + static_cast<std::ptrdiff_t>(depths.size() / 2);
    std::nth_element(depths.begin(), middle, depths.end());
    return *middle;
}

}  // namespace echoloop::multibeam
