// Sonars of several arrays in one ping, such as side-scans: each side is a single beam with an axis and a
// source of its own.
#include <gtest/gtest.h>

#include <numbers>

#include "render/fan/arrays.h"
#include "render/view.h"
#include "tests/render/meshes.h"
#include "tests/render/shots.h"

namespace echoloop {
namespace {

using std::numbers::pi;
using test::db;
using test::scene_of;

constexpr double mu_db = -27, width = deg_to_rad(0.5), height = deg_to_rad(50);

/// A side-scan's two lines, over 30 m in 300 bins.
Shot side_scan(double port_depression, double starboard_depression) {
    Shot shot = test::fan(0.5, 50, 1, 300, 30);
    shot.bearings = {-pi / 2, pi / 2};
    shot.sides = {{port_depression, 194}, {starboard_depression, 200}};
    return shot;
}

RendererOptions patterned() {
    RendererOptions options;
    options.effects =
        Effects::none().set(Effect::spreading).set(Effect::beam_pattern).set(Effect::side_lobes);
    return options;
}

double sinc(double x) { return std::abs(x) < 1e-9 ? 1 : std::sin(x) / x; }

/// dB re the source: a bin of a floor `altitude` m below that one side hears, all lobes included: mu cos^2(i)
/// R^-4 times the pattern of a line both ways (sinc(x)^4 is a half at x = 1.001906), over R dR dphi.
double floor_level(double depression, double altitude, double near, double far) {
    constexpr int ranges = 20, turns = 20000;
    double sum = 0;
    for (int r = 0; r < ranges; ++r) {
        const double range = near + (far - near) * (r + 0.5) / ranges, down = altitude / range;
        for (int i = 0; i < turns; ++i) {
            const double phi = 2 * pi * i / turns, level = std::sqrt(1 - down * down);
            // The axis looks along x, `depression` down.
            const double ahead = level * std::cos(phi) * std::cos(depression) + down * std::sin(depression);
            const double above = level * std::cos(phi) * std::sin(depression) - down * std::cos(depression);
            if (ahead <= 0) continue;
            sum += std::pow(sinc(1.001906 / std::sin(width / 2) * level * std::sin(phi)) *
                                sinc(1.001906 / std::sin(height / 2) * above),
                            4) *
                   down * down * std::pow(range, -3) * (far - near) / ranges * 2 * pi / turns;
        }
    }
    return mu_db + db(sum);
}

std::vector<double> mean_of(const Shot& one, double altitude) {
    constexpr int pings = 32;
    Renderer renderer(scene_of({test::floor_at(-altitude, 400, 1, mu_db)}), test::water_of(1500),
                      patterned());
    Shot shot = one;
    std::vector<double> mean(shot.beams() * shot.bins);
    for (shot.ping = 0; shot.ping < pings; ++shot.ping) {
        shot.random_key = shot.ping;  // moves the samples that side lobes hear
        const Echogram e = renderer.render(shot, {});
        for (std::size_t i = 0; i < mean.size(); ++i) mean[i] += e.values[i] / double{pings};
    }
    return mean;
}

// Between the first return and the main lobe the floor is heard by side lobes alone: 24 dB too loud where the
// pattern along the track is left out.
TEST(TwoSided, FloorOfEachSideFollowsTheIntegral) {
    constexpr double altitude = 10, bin = 0.1;
    const double depressions[] = {deg_to_rad(20), deg_to_rad(35)}, sources[] = {194, 200};
    const Shot shot = side_scan(depressions[0], depressions[1]);
    const std::vector<double> mean = mean_of(shot, altitude);
    for (const std::size_t side : {0U, 1U})
        for (double near = 11.1; near < 29; near += 0.9) {
            const auto i = static_cast<std::size_t>(std::lround(near / bin));
            const double first = bin * static_cast<double>(i);
            EXPECT_NEAR(db(mean[side * shot.bins + i]) - sources[side],
                        floor_level(depressions[side], altitude, first, first + bin), 0.3)
                << "side " << side << " at " << near << " m";
        }
}

// Beams far apart are arrays of their own also without a word about sides.
TEST(TwoSided, HearsWhatTwoSingleBeamsHear) {
    Shot both = side_scan(0, 0), one = both;
    both.sides.clear(), one.sides.clear();
    const std::vector<double> mean = mean_of(both, 10);
    for (const std::size_t side : {0U, 1U}) {
        one.bearings = {both.bearings[side]};
        const std::vector<double> alone = mean_of(one, 10);
        for (std::size_t i = 101; i < one.bins; ++i)
            ASSERT_NEAR(db(mean[side * one.bins + i] / alone[i]), 0, 0.02) << "side " << side << " bin " << i;
    }
}

TEST(TwoSided, TargetIsHeardOnItsSideAlone) {
    const std::vector behind{test::floor_at(-500, 1, 1, -120)};
    // 10 m to port, 20 deg down.
    const Vec3 place{0, 10 * std::cos(deg_to_rad(20)), -10 * std::sin(deg_to_rad(20))};
    Renderer renderer(Scene::from_meshes(behind, std::vector{PointTarget{"target", place, -20}}),
                      test::water_of(1500), patterned());
    const Echogram e = renderer.render(side_scan(deg_to_rad(20), deg_to_rad(20)), {});
    EXPECT_NEAR(db(test::beam_power(e, 0)), 194 - 20 - 40, 0.1);
    EXPECT_LT(db(test::beam_power(e, 1)), 194 - 20 - 40 - 60);
}

TEST(TwoSided, TruthAndObjectsAreThoseOfEachSide) {
    const auto box = [](const char* name, double y) {
        return test::box(name, {0, y, -3}, {4, 1, 6}, 0, -10);
    };
    Renderer renderer(scene_of({box("to port", 8), box("to starboard", -13)}), test::water_of(1500),
                      patterned());
    const Shot shot = side_scan(0, 0);
    Situation situation;
    situation.world_from_sonar.position = {0, 0, -3};
    situation.objects = true;
    const Echogram e = renderer.render(shot, situation);
    ASSERT_EQ(e.truth.size(), 2U);
    EXPECT_NEAR(e.truth[0].axis_range, 7.5, 0.05);
    EXPECT_NEAR(e.truth[1].axis_range, 12.5, 0.05);
    ASSERT_EQ(e.objects.size(), 2 * shot.bins);
    EXPECT_EQ(e.objects[75], 1);
    EXPECT_EQ(e.objects[shot.bins + 125], 2);
    EXPECT_EQ(e.objects[shot.bins + 75], 0);
}

/// A direction in the world that an array's axis looks in.
Vec3 axis_of(const ArrayShot& array) {
    return rotate(array.world_from_sonar.orientation * sonar_from_fan(array.shot.pan, array.shot.tilt),
                  {1, 0, 0});
}

TEST(Arrays, SidesLookDownByTheirDepression) {
    Shot shot = side_scan(deg_to_rad(20), deg_to_rad(35));
    const Pose north{{1, 2, 3}, axis_angle({0, 0, 1}, pi / 2)};
    const auto arrays = arrays_of(shot, north);
    ASSERT_EQ(arrays.size(), 2U);
    const Vec3 west{-std::cos(deg_to_rad(20)), 0, -std::sin(deg_to_rad(20))},
        east{std::cos(deg_to_rad(35)), 0, -std::sin(deg_to_rad(35))};
    EXPECT_LT(norm(axis_of(arrays[0]) - west), 1e-9);
    EXPECT_LT(norm(axis_of(arrays[1]) - east), 1e-9);
    EXPECT_EQ(arrays[1].first_beam, 1U);
    EXPECT_EQ(arrays[1].shot.source_level, 200);
    EXPECT_NE(arrays[0].shot.errors, arrays[1].shot.errors) << "of one unit, but not the same staves";
}

TEST(Arrays, OneFanStaysAsItIs) {
    Shot shot = test::forward_looking();
    const auto arrays = arrays_of(shot, {});
    ASSERT_EQ(arrays.size(), 1U);
    EXPECT_EQ(arrays[0].shot, shot);
    shot.bearings = {-pi / 2, -pi / 2 + 0.02, pi / 2 - 0.02, pi / 2};
    EXPECT_EQ(arrays_of(shot, {}).size(), 2U) << "two fans, far apart";
}

TEST(Arrays, SidesOfAShotAreChecked) {
    Shot shot = side_scan(0, 0);
    validate(shot);
    shot.sides.pop_back();
    EXPECT_THROW(validate(shot), std::invalid_argument);
    shot = side_scan(0, 2);
    EXPECT_THROW(validate(shot), std::invalid_argument);
}

}  // namespace
}  // namespace echoloop
