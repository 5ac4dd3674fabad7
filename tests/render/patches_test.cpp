// Patches of a surface: how strongly they scatter, that the mean stays, and that they stay where they are.
#include <gtest/gtest.h>

#include "render/fan/patches.h"
#include "tests/render/meshes.h"
#include "tests/render/shots.h"

namespace echoloop {
namespace {

using test::db;
using test::scene_of;

Material patchy(double strength_db) {
    Material material;
    material.name = "sand";
    material.patchiness = strength_db;
    return material;
}

struct Moments {
    double mean, scintillation;  ///< of the intensity behind fully developed speckle
};

Moments moments_of(double strength_db) {
    double sum = 0, squares = 0;
    constexpr int side = 600;
    for (int i = 0; i < side; ++i)
        for (int j = 0; j < side; ++j) {
            const double f = Patches::factor(patchy(strength_db), {0.173 * i, 0.131 * j, -7});
            sum += f / (side * side), squares += f * f / (side * side);
        }
    return {sum, 2 * squares / (sum * sum)};
}

// Scintillation 2 exp(s^2), s = dB / 4.343.
TEST(Patches, ScatterAsKDistributionsDoAndKeepTheMean) {
    for (const auto& [strength, expected] : {std::pair(2.0, 2.47), {2.36, 2.69}, {3.0, 3.22}}) {
        const Moments m = moments_of(strength);
        EXPECT_NEAR(m.scintillation, expected, 0.1) << strength;
        EXPECT_NEAR(db(m.mean), 0, 0.1) << strength;
    }
}

// A footprint of so many correlation lengths, 2.36 dB.
TEST(Patches, AverageOutOverAFootprint) {
    const double s = 2.36 / 4.343;
    const PatchNoise& noise = PatchNoise::shared();
    for (const auto& [lengths, expected] : {std::pair(1.0, 2.52), {2.0, 2.28}, {8.0, 2.01}}) {
        const auto side = static_cast<std::uint32_t>(lengths * PatchNoise::length);
        double sum = 0, squares = 0;
        int count = 0;
        for (std::uint32_t z = 0; z < 64; z += 4)
            for (std::uint32_t y = 0; y < 64; y += 8)
                for (std::uint32_t x = 0; x < 64; x += 8, ++count) {
                    double mean = 0;
                    for (std::uint32_t i = 0; i < side * side; ++i) {
                        const std::uint32_t cell = (x + i % side) % 64 + 64 * ((y + i / side) % 64 + 64 * z);
                        const double n = noise.at(cell) * double{PatchNoise::scale};
                        mean += std::exp(s * n - s * s / 2) / (side * side);
                    }
                    sum += mean, squares += mean * mean;
                }
        EXPECT_NEAR(2 * squares / sum * count / sum, expected, 0.1) << lengths;
    }
}

RendererOptions lit(bool texture) {
    RendererOptions options = test::boxes();
    options.effects.set(Effect::beam_pattern).set(Effect::texture, texture);
    return options;
}

std::shared_ptr<const Scene> patchy_floor(double strength_db, double z = -5) {
    Mesh floor = test::floor_at(z, 100);
    floor.material.patchiness = strength_db;
    return scene_of({floor});
}

Shot narrow() {
    Shot shot = test::fan(60, 20, 120, 400, 20);
    shot.tilt = deg_to_rad(-25);
    return shot;
}

TEST(Patches, AFloorKeepsItsMeanLevelAndGetsPatches) {
    Renderer with(patchy_floor(2.36), test::water_of(1500), lit(true)),
        without(patchy_floor(2.36), test::water_of(1500), lit(false));
    double a = 0, b = 0, squares = 0;
    int count = 0;
    for (int place = 0; place < 12; ++place) {
        const Pose pose{{3.7 * place, 1.3 * place, 0}, {}};
        const Echogram patches = with.render(narrow(), pose), even = without.render(narrow(), pose);
        for (std::size_t i = 0; i < even.values.size(); ++i) {
            if (i % 400 < 160 || i % 400 > 260) continue;
            const double ratio = patches.values[i] / even.values[i];
            a += patches.values[i], b += even.values[i], squares += std::pow(db(ratio), 2), ++count;
        }
    }
    EXPECT_NEAR(db(a / b), 0, 0.3);
    EXPECT_GT(std::sqrt(squares / count), 1.0) << "dB, of cells smaller than the patches";
}

TEST(Patches, ArePartOfWhatMoves) {
    Mesh raft = test::quad("raft", {2, -8, -5}, {18, -8, -5}, {18, 8, -5}, {2, 8, -5});
    raft.material.patchiness = 3;
    const std::vector<std::string> movable{"raft"};
    const auto scene = Scene::from_meshes(std::vector{raft}, {}, movable);
    Renderer renderer(scene, test::water_of(1500), lit(true));
    const Echogram first = renderer.render(narrow(), {});
    Situation moved{Pose{{40, 7, 0}, {}}};
    moved.movers = {Pose{{40, 7, 0}, {}}};
    const Echogram second = renderer.render(narrow(), moved);
    double difference = 0, sum = 0;
    for (std::size_t i = 0; i < first.values.size(); ++i)
        difference += std::abs(first.values[i] - second.values[i]), sum += first.values[i];
    EXPECT_LT(difference, 0.02 * sum) << "the same raft before the same sonar";
    moved.movers = {Pose{{42, 7, 0}, {}}};
    const Echogram third = renderer.render(narrow(), moved);
    double other = 0;
    for (std::size_t i = 0; i < first.values.size(); ++i)
        other += std::abs(first.values[i] - third.values[i]);
    EXPECT_GT(other, 0.1 * sum);
}

TEST(Patches, OffAMaterialIsEven) {
    Renderer off(patchy_floor(3), test::water_of(1500), lit(false)),
        even(patchy_floor(0), test::water_of(1500), lit(true));
    EXPECT_EQ(off.render(narrow(), {}).values, even.render(narrow(), {}).values);
}

TEST(Patches, RowsOfBeamsSeeThem) {
    Shot shot = test::fan(40, 2, 40, 300, 15);
    for (double row = -40; row <= -20; row += 1) shot.elevations.push_back(deg_to_rad(row));
    Renderer with(patchy_floor(2.36), test::water_of(1500), lit(true)),
        without(patchy_floor(2.36), test::water_of(1500), lit(false));
    const Echogram a = with.render(shot, {}), b = without.render(shot, {});
    EXPECT_NE(a.values, b.values);
    EXPECT_NEAR(db(test::total_power(a) / test::total_power(b)), 0, 0.7) << "one place of one floor";
}

}  // namespace
}  // namespace echoloop
