// What a sonar sees by bent rays, against rays of their own and V34, V35 of the reference values.
#include <gtest/gtest.h>

#include <cmath>

#include "render/refraction.h"
#include "tests/render/meshes.h"
#include "tests/render/shots.h"

namespace echoloop {
namespace {

using test::db, test::scene_of;
using Profile = std::vector<SoundSpeedPoint>;

const Profile thermocline{{0, 1515}, {10, 1515}, {20, 1485}};

Water layered(const Profile& profile) {
    Water water;
    water.profile = profile;
    return water;
}

/// Drawn, or by rays that bend.
class BentPicture : public testing::TestWithParam<const char*> {
  protected:
    static RendererOptions bending() {
        RendererOptions options{.sampler = GetParam()};
        options.effects = Effects::none().set(Effect::spreading).set(Effect::refraction);
        return options;
    }
};

INSTANTIATE_TEST_SUITE_P(By, BentPicture, testing::Values("raster", "native", "rays"),
                         [](const auto& one) { return std::string(one.param); });

/// Upright and looking down: beams at the angles (deg) from the vertical, 1 deg wide.
Shot sounder(std::initializer_list<double> angles, double range) {
    Shot shot = test::fan(1, 3, 1, 4000, range, 1515);
    shot.bearings.clear();
    for (const double angle : angles) shot.bearings.push_back(deg_to_rad(angle));
    shot.tilt = deg_to_rad(-90);
    return shot;
}

// V35: the bottom lies where a host that traces rays with the true profile finds it flat.
TEST_P(BentPicture, BottomBelowAThermocline) {
    Renderer renderer(scene_of({test::floor_at(-100, 500)}), layered(thermocline), bending());
    const Echogram e =
        renderer.render(sounder({0, 10, 20, 30, 40, 45, 50, 60, 65, 70}, 270), Pose{{0, 0, -2}, {}});
    EXPECT_EQ(e.sound_speed, 1515);
    const double ms[] = {65.820, 66.799, 69.886, 75.574, 84.910, 91.540, 100.015, 125.438, 144.944, 172.022};
    for (std::size_t beam = 0; beam < std::size(ms); ++beam) {
        const double range = ms[beam] / 1e3 * 1515;
        EXPECT_NEAR(double{e.truth[beam].axis_range} / range, 1, 3e-4) << beam;
        double sum = 0, moment = 0;
        for (std::size_t bin = 0; bin < e.shot.bins; ++bin)
            sum += double{e.beam(beam)[bin]}, moment += double{e.beam(beam)[bin]} * e.bin_range(bin);
        EXPECT_NEAR(moment / sum / range, 1, 2e-3) << beam;
    }
}

// One-way spreading G at 45 and 60 deg is -42.48 and -45.11 dB; the bottom is met at 43.88 and 58.09 deg.
TEST_P(BentPicture, LevelsBelowAThermocline) {
    const auto scene = scene_of({test::floor_at(-100, 500)});
    RendererOptions options = bending();
    const auto level = [&](std::size_t beam) {
        Renderer renderer(scene, layered(thermocline), options);
        return db(test::beam_power(renderer.render(sounder({45, 60}, 270), Pose{{0, 0, -2}, {}}), beam));
    };
    const double bent[2] = {level(0), level(1)};
    options.effects.set(Effect::refraction, false);
    const double angles[] = {45, 60}, spreads[] = {-42.48, -45.11}, arrivals[] = {43.88, 58.09};
    for (std::size_t beam = 0; beam < 2; ++beam) {
        const double straight_cosine = std::cos(deg_to_rad(angles[beam])), straight = 98 / straight_cosine;
        const double expected = spreads[beam] + 20 * std::log10(straight) +
                                10 * std::log10(std::cos(deg_to_rad(arrivals[beam])) / straight_cosine);
        EXPECT_NEAR(bent[beam] - level(beam), expected, 0.15) << angles[beam];
    }
}

/// m of c t, of a ray at that elevation (deg) to the distance `to`.
double range_of_wall(const Profile& profile, double depth, double elevation_deg, double to) {
    double low = 0, high = 1;
    for (int i = 0; i < 60; ++i) {
        const double middle = (low + high) / 2;
        (ray_after(profile, {0, depth, deg_to_rad(elevation_deg)}, middle).distance < to ? low : high) =
            middle;
    }
    return high * sound_speed_at(profile, depth);
}

// Two triangles, 150 m wide and 95 m high: they are split up where rays bend.
TEST_P(BentPicture, LargeWallIsMetWhereRaysOfTheirOwnMeetIt) {
    for (const Profile& profile :
         {thermocline, Profile{{0, 1500}, {100, 1450}}, Profile{{0, 1450}, {100, 1500}}}) {
        Renderer renderer(scene_of({test::wall_at(100, 150, -95, -0.5)}), layered(profile), bending());
        for (const double depth : {5.0, 15.0, 40.0})
            for (const double elevation : {-35.0, -20.0, -8.0, -3.0}) {
                Shot shot = test::fan(4, 4, 4, 2000, 200);
                shot.tilt = deg_to_rad(elevation);
                const Echogram e = renderer.render(shot, Pose{{0, 0, -depth}, axis_angle({0, 0, 1}, 0.02)});
                const RayPoint end = ray_after(profile, {0, depth, deg_to_rad(elevation)},
                                               range_of_wall(profile, depth, elevation, 100) / e.sound_speed);
                if (end.depth > 94 || end.depth < 1) continue;
                // The middle beams look 0.5 deg to either side of the fan's axis, which is turned by 0.02
                // rad.
                const double expected = range_of_wall(profile, depth, elevation, 100 / std::cos(0.02));
                EXPECT_NEAR((e.truth[1].axis_range + e.truth[2].axis_range) / 2, expected, 0.05)
                    << depth << " m, " << elevation << " deg";
            }
    }
}

// V34: nothing at the sonar's depth of 5 m is heard from beyond 141.07 m.
TEST_P(BentPicture, ShadowIsSilent) {
    const Profile profile{{0, 1500}, {50, 1350}};
    for (const double x : {110.0, 137.0, 146.0, 180.0}) {
        Renderer renderer(scene_of({test::wall_at(x, 1, -5.2, -4.8)}), layered(profile), bending());
        Shot shot = test::fan(4, 40, 1, 2000, 200);
        const double power = test::total_power(renderer.render(shot, Pose{{0, 0, -5}, {}}));
        if (x < 141)
            EXPECT_GT(power, 0) << x;
        else
            EXPECT_EQ(power, 0) << x;
    }
}

// A mover is drawn from its own frame, in which up is elsewhere.
TEST_P(BentPicture, MoversBendAsTheWorldDoes) {
    const Profile profile{{0, 1500}, {100, 1300}};
    const Shot shot = test::fan(10, 30, 5, 1000, 120);
    const Pose sonar{{0, 0, -20}, {}};
    Mesh wall = test::wall_at(80, 40, -60, 0);
    Renderer still(scene_of({wall}), layered(profile), bending());
    const Echogram expected = still.render(shot, sonar);
    // The same wall, given in a frame that is turned.
    const Pose turned{{3, -2, 5}, axis_angle({1, 0, 0}, 1.1)};
    for (Vec3& p : wall.positions) p = inverse(turned) * p;
    for (Vec3& n : wall.normals) n = rotate(conjugate(turned.orientation), n);
    const std::string names[] = {wall.object};
    Renderer moving(Scene::from_meshes(std::span(&wall, 1), {}, names), layered(profile), bending());
    Situation situation(sonar);
    situation.movers = {turned};
    const Echogram e = moving.render(shot, situation);
    for (std::size_t beam = 0; beam < 5; ++beam) {
        EXPECT_NEAR(e.truth[beam].axis_range, expected.truth[beam].axis_range, 0.01);
        EXPECT_NEAR(db(test::beam_power(e, beam)), db(test::beam_power(expected, beam)), 0.05);
    }
}

TEST_P(BentPicture, SwitchedOffOrWithoutAProfileRaysAreStraight) {
    const auto scene = scene_of({test::floor_at(-100, 500)});
    const Shot shot = sounder({0, 30, 60}, 270);
    const Pose pose{{0, 0, -2}, {}};
    RendererOptions options = bending();
    Water water = layered(thermocline);
    water.depth = 2;
    const auto values = [&] { return Renderer(scene, water, options).render(shot, pose).values; };
    const auto bent = values();
    options.effects.set(Effect::refraction, false);
    const auto straight = values();
    water.profile.clear(), water.sound_speed = 1515;
    EXPECT_EQ(values(), straight);
    options.effects.set(Effect::refraction);
    EXPECT_EQ(values(), straight);
    EXPECT_NE(bent, straight);
    // Below half a bin: the bytes of straight rays.
    water.sound_speed.reset(), water.profile = {{0, 1515}, {200, 1515.1}};
    water.depth = 0;
    const Water even = test::water_of(sound_speed_at(water.profile, 2));
    const auto nearly = values();
    water = even;
    EXPECT_EQ(values(), nearly);
}

TEST_P(BentPicture, IsTheSameHoweverManyThreadsDrawAndWhateverWasDrawnBefore) {
    const auto scene = scene_of({test::seabed(60), test::box("box", {12, 3, -5}, {2, 3, 4})});
    const Water water = layered({{0, 1530}, {4, 1528}, {6, 1490}, {30, 1480}});
    Shot shot = test::forward_looking();
    RendererOptions options{.sampler = GetParam()};
    Renderer one(scene, water, options);
    options.drawing_threads = 2;
    Renderer two(scene, water, options);
    two.render(shot, Pose{{1, 0, -3}, {}});
    EXPECT_EQ(one.render(shot, Pose{{0, 0, -2}, {}}).values, two.render(shot, Pose{{0, 0, -2}, {}}).values);
}

}  // namespace
}  // namespace echoloop
