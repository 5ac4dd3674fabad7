// The rasteriser against rays, on random scenes of boxes.
#include "tests/render/ray_caster.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/render/meshes.h"
#include "tests/render/shots.h"

namespace echoloop {
namespace {

std::vector<Mesh> random_boxes(std::mt19937& random) {
    const auto within = [&](double low, double high) {
        return std::uniform_real_distribution<>(low, high)(random);
    };
    std::vector<Mesh> meshes{test::floor_at(-6, 100)};
    for (int i = 0; i < 12; ++i) {
        const double range = within(6, 40), bearing = within(-1.2, 1.2);
        meshes.push_back(test::box("box",
                                   {range * std::cos(bearing), range * std::sin(bearing), within(-6, 2)},
                                   {within(0.5, 4), within(0.5, 4), within(0.5, 4)}, within(0, 3)));
    }
    return meshes;
}

/// Shot's definition of a direction, written out again from its documentation.
Vec3 direction(const Shot& shot, const Pose& pose, double bearing, double elevation) {
    const Vec3 in_fan{std::cos(elevation) * std::cos(bearing), -std::cos(elevation) * std::sin(bearing),
                      std::sin(elevation)};
    const Vec3 tilted = rotate(axis_angle({0, 1, 0}, -shot.tilt), in_fan);
    return rotate(pose.orientation, rotate(axis_angle({0, 0, 1}, -shot.pan), tilted));
}

TEST(RayCaster, AgreesOnTheAxisOfEveryBeam) {
    std::mt19937 random(7);
    std::size_t compared = 0, different = 0;
    for (int round = 0; round < 8; ++round) {
        const auto meshes = random_boxes(random);
        Renderer renderer(test::scene_of(meshes), test::water_of(1500), test::boxes());
        Shot shot = test::fan(130, 24, 130, 500, 50);
        shot.pan = 0.3 * round - 1;
        shot.tilt = deg_to_rad(-8);
        shot.ping = static_cast<std::uint64_t>(round);
        const Pose pose{{0, 0, -2}, from_rpy(0.05 * round, -0.04 * round, 0.7)};
        const Echogram e = renderer.render(shot, pose);
        for (std::size_t beam = 0; beam < e.beams(); ++beam) {
            const double range =
                test::cast(meshes, pose.position, direction(shot, pose, shot.bearings[beam], 0));
            const double seen =
                std::isnan(e.truth[beam].axis_range) ? 1e9 : static_cast<double>(e.truth[beam].axis_range);
            const bool both_beyond = range > 50 && seen > 50;
            ++compared;
            different += !both_beyond && std::abs(seen - range) > 0.02 * range;
        }
    }
    // Only beams whose axis passes an edge within a pixel may differ.
    EXPECT_LE(different, compared / 50) << "of " << compared;
}

TEST(RayCaster, AgreesOnTheNearestRangeInEveryBeam) {
    std::mt19937 random(11);
    for (int round = 0; round < 3; ++round) {
        const auto meshes = random_boxes(random);
        Renderer renderer(test::scene_of(meshes), test::water_of(1500), test::boxes());
        Shot shot = test::fan(90, 20, 45, 500, 50);
        shot.tilt = deg_to_rad(-12);
        const Pose pose{{0, 0, -2}, axis_angle({0, 0, 1}, 0.4 * round)};
        const Echogram e = renderer.render(shot, pose);
        std::size_t different = 0;
        for (std::size_t beam = 0; beam < e.beams(); ++beam) {
            double nearest = std::numeric_limits<double>::infinity();
            for (int i = 0; i < 10; ++i)
                for (int j = 0; j < 60; ++j)
                    nearest = std::min(
                        nearest,
                        test::cast(meshes, pose.position,
                                   direction(shot, pose,
                                             shot.bearings[beam] + shot.beam_width * ((i + 0.5) / 10 - 0.5),
                                             shot.fan_height * ((j + 0.5) / 60 - 0.5))));
            if (nearest > 49) continue;
            different += !(std::abs(e.truth[beam].nearest_range - nearest) < 0.15 + 0.01 * nearest);
        }
        EXPECT_LE(different, 1U);
    }
}

}  // namespace
}  // namespace echoloop
