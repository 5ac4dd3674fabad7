// The ways straight to a target in layered water.
#include <array>
#include <cmath>

#include "render/paths/path_ping.h"

namespace echoloop {
namespace {

/// Whether something is on the ray.
bool hidden_on(const PathPing& ping, Vec3 point, const Eigenray& ray, Vec3 ahead, double distance) {
    std::array<double, 16> below{};
    const double step = distance / static_cast<double>(below.size());
    ping.eigenrays->course(ray.elevation, step, below);
    Vec3 from = ping.sonar;
    for (std::size_t i = 0; i < below.size(); ++i) {
        const Vec3 to = i + 1 < below.size() ? ping.sonar + static_cast<double>(i + 1) * step * ahead -
                                                   below[i] * Vec3{0, 0, 1}
                                             : point;
        if (ping.space.blocked(from, to)) return true;
        from = to - 1e-3 * (to - from);  // pieces overlap, since nothing is seen right at their ends
    }
    return false;
}

}  // namespace

std::vector<Way> direct_ways(const PathPing& ping, Vec3 point) {
    const Vec3 line = point - ping.sonar;
    const double distance = std::hypot(line.x, line.y);
    static thread_local std::vector<Eigenray> rays;
    rays.clear();
    if (ping.rays != nullptr && ping.eigenrays != nullptr) ping.eigenrays->find(distance, -line.z, rays);
    std::vector<Way> ways;
    const Vec3 ahead = distance > 0 ? 1 / distance * Vec3{line.x, line.y, 0} : Vec3{1, 0, 0};
    for (const Eigenray& ray : rays) {
        if (hidden_on(ping, point, ray, ahead, distance)) continue;
        const Vec3 direction = std::cos(ray.elevation) * ahead + std::sin(ray.elevation) * Vec3{0, 0, 1};
        ways.push_back({ping.seen(direction), ray.length, ping.spreading ? std::sqrt(ray.focus) : 1, 1, 0});
    }
    if (!rays.empty()) return ways;
    if (auto way = direct_way(ping, point)) {
        if (const auto sight = ping.sight(point); ping.rays != nullptr && ping.spreading)
            way->reflection = std::sqrt(
                ping.rays->focus(static_cast<float>(sight->direction.z), static_cast<float>(sight->length)));
        ways.push_back(*way);
    }
    return ways;
}

}  // namespace echoloop
