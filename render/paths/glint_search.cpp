#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>

#include "render/paths/searches.h"

namespace echoloop {
namespace {

constexpr std::size_t most_glints = 32;
constexpr double nearest_mirror = 1e-2;  ///< m

struct Glint {
    TargetEcho echo;
    Vec3 point;
};

/// Empty where it cannot be heard.
std::optional<Glint> glint_of(const PathPing& ping, const Mirrors& mirrors, std::size_t face) {
    const double range = mirrors.before(face, ping.sonar);
    const MirrorFace& mirror = mirrors.faces()[face];
    const Vec3 point = ping.sonar - (dot(mirror.normal, ping.sonar) - mirror.offset) * mirror.normal;
    const Material& material = mirrors.material(face);
    const double reflection = material.reflection * coherent_loss(ping.wavenumber, material.roughness, 1);
    const double loudest = ping.arrival(range, range) * range / 2 * std::abs(reflection);
    if (!(loudest > ping.least)) return std::nullopt;
    const Foot foot = mirrors.foot(face, point, mirror_zone(ping.wavenumber, range, range, ping.resolution));
    const auto sight = ping.sight(foot.nearest);
    if (!sight) return std::nullopt;
    const double length = norm(foot.nearest - ping.sonar);
    const double stretch = ping.rays != nullptr ? sight->length / length : 1;
    const FanDirection seen = ping.received(ping.seen(sight->direction), stretch * range);
    const double amplitude = loudest * seen.transmit * seen.receive * std::abs(foot.share);
    if (!(std::abs(amplitude) > ping.least)) return std::nullopt;
    const double phase = 2 * ping.wavenumber * stretch * range + std::arg(foot.share) +
                         (amplitude * reflection < 0 ? std::numbers::pi : 0);
    return Glint{{foot.outside > 0 ? sight->length : stretch * range, amplitude * amplitude,
                  std::remainder(phase, 2 * std::numbers::pi), seen.bearing, 1, seen.elevation, seen.turned},
                 foot.nearest};
}

}  // namespace

std::vector<std::size_t> faces_ahead(const PathPing& ping, const Mirrors& mirrors) {
    std::vector<std::size_t> out;
    const auto near = mirrors.near(ping.sonar, ping.end_range, ping.resolution);
    for (std::size_t face = 0; face < near.size(); ++face) {
        if (near[face] == 0) continue;
        const double range = mirrors.before(face, ping.sonar);
        if (!(range > nearest_mirror) || range >= ping.end_range) continue;
        const MirrorFace& mirror = mirrors.faces()[face];
        const double late =
            std::sqrt(2 * range * ping.resolution);  // an edge that is farther off comes later
        const Vec3 to_middle = mirror.middle - ping.sonar;
        const double off = std::sqrt(std::max(0.0, dot(to_middle, to_middle) - range * range));
        if (off > mirror.reach + late) continue;
        if (ping.arrival(range, range) * range / 2 * std::abs(mirrors.material(face).reflection) > ping.least)
            out.push_back(face);
    }
    return out;
}

void find_glints(const PathPing& ping, const Mirrors& mirrors, std::span<const std::size_t> faces,
                 std::vector<TargetEcho>& out) {
    std::vector<Glint> found;
    for (const std::size_t face : faces)
        if (const auto glint = glint_of(ping, mirrors, face)) found.push_back(*glint);
    std::ranges::stable_sort(found, std::greater{}, [](const Glint& glint) { return glint.echo.power; });
    if (found.size() > most_glints) found.resize(most_glints);
    for (const Glint& glint : found)
        if (!ping.hidden(glint.point)) out.push_back(glint.echo);
}

}  // namespace echoloop
