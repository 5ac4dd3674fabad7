// Rays in layered water against closed forms, and what straight rays get wrong.
#include "render/refraction.h"

#include <gtest/gtest.h>

#include <cmath>

#include "render/motion.h"

namespace echoloop {
namespace {

using Profile = std::vector<SoundSpeedPoint>;

const Profile v14{{0, 1500}, {100, 1450}};  // q = -0.5 /s

TEST(SoundSpeedProfile, IsLinearBetweenAndConstantBeyond) {
    const Profile profile{{10, 1500}, {20, 1480}, {40, 1490}};
    EXPECT_EQ(sound_speed_at(profile, 0), 1500);
    EXPECT_EQ(sound_speed_at(profile, 15), 1490);
    EXPECT_EQ(sound_speed_at(profile, 20), 1480);
    EXPECT_EQ(sound_speed_at(profile, 30), 1485);
    EXPECT_EQ(sound_speed_at(profile, 100), 1490);
}

// V14 of the reference values: radius c / (|q| cos e) = 3000 m, drop 0.600 m at 60 m.
TEST(Refraction, ConstantGradientGivesAnArc) {
    const RayPoint end = ray_after(v14, {}, 60.0 / 1500);
    EXPECT_NEAR(end.distance, 60, 0.02);
    EXPECT_NEAR(end.depth, 0.600, 0.001);
    // On the circle of 3000 m about the point 3000 m below the start.
    EXPECT_NEAR(std::hypot(end.distance, 3000 - end.depth), 3000, 1e-6);
    EXPECT_NEAR(end.elevation, -std::asin(end.distance / 3000), 1e-9);
}

TEST(Refraction, SteepRaysHaveLargerCircles) {
    const double e = deg_to_rad(-40), radius = 3000 / std::cos(e);
    const RayPoint end = ray_after(v14, {0, 0, e}, 0.04);
    const double cx = radius * std::sin(e), cz = radius * std::cos(e);
    EXPECT_NEAR(std::hypot(end.distance - cx, end.depth - cz), radius, 1e-6);
    EXPECT_NEAR(std::cos(end.elevation) / sound_speed_at(v14, end.depth), std::cos(e) / 1500, 1e-12);
}

// Travel time of a vertical ray: integral of dz / c = ln(c1 / c0) / q.
TEST(Refraction, PlumbRayTakesTheIntegralOfItsSlowness) {
    const double time = std::log(1450.0 / 1500) / -0.5;
    EXPECT_NEAR(ray_after(v14, {0, 0, deg_to_rad(-90)}, time).depth, 100, 1e-3);
}

// A sound channel: the ray swings about the axis and passes it after each half turn at its old angle.
TEST(Refraction, RayOfASoundChannelComesBackToItsAxis) {
    const Profile channel{{0, 1550}, {100, 1500}, {200, 1550}};
    const double e = deg_to_rad(5), radius = 1500 / (0.5 * std::cos(e)), chord = 2 * radius * std::sin(e);
    const double half_turn = 2 * std::asinh(std::tan(e)) / 0.5;
    const RayPoint once = ray_after(channel, {0, 100, e}, half_turn);
    EXPECT_NEAR(once.distance, chord, 1e-6);
    EXPECT_NEAR(once.depth, 100, 1e-6);
    const RayPoint twice = ray_after(channel, {0, 100, e}, 2 * half_turn + 1e-6);
    EXPECT_NEAR(twice.distance, 2 * chord, 0.01);
    EXPECT_NEAR(twice.elevation, e, 1e-5);
}

TEST(Refraction, IsotropicWaterKeepsRaysStraight) {
    const Profile water{{5, 1480}, {50, 1480}};
    const RayPoint end = ray_after(water, {0, 10, deg_to_rad(-30)}, 0.1);
    EXPECT_NEAR(end.distance, 148 * std::cos(deg_to_rad(30)), 1e-9);
    EXPECT_NEAR(end.depth, 10 + 74, 1e-9);
    EXPECT_NEAR(straight_ray_error(water, 1480, 10, 60, -0.5, 0.5).displacement, 0, 1e-9);
}

TEST(Refraction, StraightRaysAreWrongByTheDropOfTheArc) {
    const auto error =
        straight_ray_error(v14, sound_speed_at(v14, 10), 10, 60, deg_to_rad(-5), deg_to_rad(5));
    EXPECT_NEAR(error.displacement, 0.60, 0.02);
    EXPECT_EQ(error.range, 60);
    // Plumb rays do not bend, but sound is faster or slower along them: 1/2 q R^2 / c of range.
    const auto plumb = straight_ray_error(v14, 1500, 0, 60, deg_to_rad(-90), deg_to_rad(-90));
    EXPECT_NEAR(plumb.displacement, 0.5 * 0.5 * 3600 / 1500, 0.01);
    EXPECT_EQ(straight_ray_error({}, 1500, 10, 60, -1, 1).displacement, 0);
}

// A scenario may give a sound speed beside the profile: echoes are shown by it, however fast sound is there.
TEST(Refraction, AGivenSoundSpeedThatIsNotTheProfilesCounts) {
    const Profile water{{0, 1450}, {100, 1450}}, point{{0, 1450}};
    for (const Profile& profile : {water, point})
        EXPECT_NEAR(straight_ray_error(profile, 1600, 10, 60, -0.1, 0.1).displacement,
                    60 * (1 - 1450.0 / 1600), 1e-6);
}

TEST(Water, TakesItsSoundSpeedFromTheProfile) {
    Water water;
    water.profile = {{0, 1500}, {100, 1450}};
    water.depth = 20;
    EXPECT_DOUBLE_EQ(sound_speed(water), 1490);
    water.sound_speed = 1470;
    EXPECT_EQ(sound_speed(water), 1470);
}

TEST(Water, RefusesProfilesThatAreNone) {
    Water water;
    water.profile = {{10, 1500}, {10, 1490}};
    EXPECT_THROW(validate(water), std::invalid_argument);
    water.profile = {{0, 1500}, {10, 1200}};
    EXPECT_THROW(validate(water), std::invalid_argument);
    water.profile = {{-1, 1500}};
    EXPECT_THROW(validate(water), std::invalid_argument);
    water.profile = {{0, 1500}, {10, 1490}};
    EXPECT_NO_THROW(validate(water));
}

// V15 and V38 of the reference values; 2 v f / c is the first order of it.
TEST(Doppler, ShiftsWhatComesNearer) {
    EXPECT_NEAR(doppler_shift(750e3, 1, 1500), 1000, 1);
    EXPECT_NEAR(doppler_shift(750e3, -2, 1500), -2000, 3);
    EXPECT_NEAR(doppler_shift(600e3, 2, 1500), 1602.1, 0.1);
}

TEST(Doppler, SweepsAreTakenForNearer) {
    EXPECT_NEAR(sweep_bias(300e3, 12e-3, 10e3), 0.360, 1e-9);
    EXPECT_NEAR(sweep_bias(300e3, 4e-3, 40e3), 0.0300, 1e-9);
    EXPECT_EQ(sweep_bias(300e3, 100e-6, 40e3), 0) << "too little to tell";
    EXPECT_EQ(sweep_bias(300e3, 4e-3, 0), 0) << "no sweep";
}

}  // namespace
}  // namespace echoloop
