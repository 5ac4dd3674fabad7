#include "render/renderer_checks.h"

#include <cmath>
#include <stdexcept>

namespace echoloop {
namespace {

void check(const Pose& pose) {
    const Vec3 p = pose.position;
    const Quat q = pose.orientation;
    const double length = std::sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
    if (!(norm(p) < 1e7)) throw std::invalid_argument("pose: position must be finite and within 1e7 m");
    if (!(std::abs(length - 1) < 1e-3))
        throw std::invalid_argument("pose: orientation must be a unit quaternion");
}

void check(const Motion& motion) {
    constexpr double most = 100;  // m/s and rad/s
    if (!(norm(motion.velocity) <= most && norm(motion.turning) <= most))
        throw std::invalid_argument("situation: velocities must be finite and within 100 m/s and rad/s");
}

/// Fills `movers`.
void place_movers(const Situation& situation, const Scene& scene, std::vector<Pose>& movers) {
    const auto known = scene.movers();
    if (situation.movers.size() > known.size())
        throw std::invalid_argument("movers: there are poses for more than the scene has");
    movers.clear();
    for (std::size_t i = 0; i < known.size(); ++i)
        movers.push_back(i < situation.movers.size() ? situation.movers[i] : known[i].rest);
    for (const Pose& pose : movers) check(pose);
}

}  // namespace

void validate(const RendererOptions& options) {
    if (!(options.columns_per_beam >= 1 && options.columns_per_beam <= 64))
        throw std::invalid_argument("renderer: columns_per_beam must be within 1..64");
    if (!(options.pixel_density >= 0.1 && options.pixel_density <= 64))
        throw std::invalid_argument("renderer: pixel_density must be within 0.1..64");
    if (options.sampler != "auto" && options.sampler != "raster" && options.sampler != "native" &&
        options.sampler != "rays")
        throw std::invalid_argument("renderer: sampler must be auto, raster, native or rays");
    if (!(options.drawing_threads >= 1 && options.drawing_threads <= 64))
        throw std::invalid_argument("renderer: drawing_threads must be within 1..64");
}

void check(const Situation& situation, const Scene& scene, std::vector<Pose>& movers) {
    check(situation.world_from_sonar);
    if (!(situation.detail >= 0.1 && situation.detail <= 1))
        throw std::invalid_argument("situation: detail must be within 0.1..1");
    if (!(situation.density >= 0.1 && situation.density <= 1))
        throw std::invalid_argument("situation: density must be within 0.1..1");
    place_movers(situation, scene, movers);
    check(Motion{situation.velocity, situation.turning});
    if (situation.mover_motions.size() > movers.size())
        throw std::invalid_argument("movers: there are motions for more than the scene has");
    for (const Motion& motion : situation.mover_motions) check(motion);
}

}  // namespace echoloop
