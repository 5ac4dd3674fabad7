// The rasteriser against Embree, in a scene of the program's own: first surfaces along the axes of beams.
#include <gtest/gtest.h>

#include "render/paths/lobe_cells.h"
#include "render/paths/ray_scene.h"
#include "render/view.h"
#include "tests/render/shots.h"

namespace echoloop {
namespace {

TEST(EmbreeCheck, FirstSurfacesAlongBeamsOfTheManifold) {
    const std::string file = std::string(ECHOLOOP_SOURCE_DIR) + "/config/scenes/manifold.glb";
    const std::shared_ptr<const Scene> scene = Scene::load(file);
    const RayScene rays(scene);
    RendererOptions options;
    options.effects = Effects::none();
    Renderer renderer(scene, test::water_of(1500), options);
    std::size_t compared = 0, different = 0, seen_by_both = 0;
    for (int round = 0; round < 4; ++round) {
        Shot shot = test::forward_looking();
        shot.tilt = deg_to_rad(-10 - 5 * round);
        const double yaw = round * std::numbers::pi / 2;  // the manifold is in the middle
        const Pose pose{{-18 * std::cos(yaw), -18 * std::sin(yaw), -3}, from_rpy(0, 0, yaw)};
        const Echogram echogram = renderer.render(shot, pose);
        const Quat world_from_fan = pose.orientation * sonar_from_fan(shot.pan, shot.tilt);
        for (std::size_t beam = 0; beam < echogram.beams(); ++beam) {
            const Vec3 axis = rotate(world_from_fan, fan_direction(shot.bearings[beam], 0));
            const auto hit = rays.hit(pose.position, axis, 49);
            const float range = echogram.truth[beam].axis_range;
            ++compared;
            seen_by_both += hit && !std::isnan(range);
            if (hit) different += !(std::abs(range - hit->range) < 0.02 * hit->range);
            if (!hit) different += range < 48.5;
        }
    }
    EXPECT_GT(seen_by_both, compared / 2);
    EXPECT_LE(different, 5 * compared / 100) << "of " << compared;  // axes that pass an edge within a pixel
}

}  // namespace
}  // namespace echoloop
