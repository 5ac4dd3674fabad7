// A fan whose staves differ hears what is beside its beams at the floor that their variance gives.
#include <gtest/gtest.h>

#include <numbers>

#include "render/acoustics/stave_errors.h"
#include "tests/render/meshes.h"
#include "tests/render/shots.h"

namespace echoloop {
namespace {

using test::db;
using test::scene_of;

/// 121 beams of 1 deg, shaded, one way: 149 staves half a wavelength apart, which count as 109.
Shot fan() {
    Shot shot = test::fan(121, 20, 121, 200, 20);
    shot.horizontal = {ApertureShape::hamming, 1};
    shot.vertical = {ApertureShape::line, 2};
    shot.errors = {1, deg_to_rad(10), 0};
    return shot;
}

/// Beams beside the loud one that are heard, deg off it.
constexpr double asides[] = {15, 20, 25, 30, 35, 40, 45, 50, 55};

/// By how much errors that are alike over exp(-(x / L)^2), L in wavelengths, raise the floor at `aside`,
/// against independent ones: the Fourier transform of that over staves half a wavelength apart.
double coupling(double aside) {
    const double length = StaveErrors::coupled, u = std::sin(deg_to_rad(aside));
    const double pi = std::numbers::pi;
    return length * std::sqrt(pi) / 0.5 * std::exp(-std::pow(pi * length * u, 2));
}

double mean_coupling() {
    double sum = 0;
    for (const double aside : asides) sum += coupling(aside);
    return sum / std::size(asides);
}

/// (sa^2 + sp^2) / N_eff of these, and what of it comes out at those beams.
const double floor_level = db((std::pow(1 / 8.686, 2) + std::pow(deg_to_rad(10), 2)) / 109 * mean_coupling());

RendererOptions patterned(bool errors) {
    RendererOptions options;
    options.effects =
        Effects::none().set(Effect::spreading).set(Effect::beam_pattern).set(Effect::side_lobes);
    options.effects.set(Effect::array_errors, errors);
    return options;
}

/// Mean power of the beams 15 to 55 deg beside the middle one, re that one, over 24 units.
double beside_of(Renderer& renderer, Shot shot = fan()) {
    constexpr int units = 24;
    double beside = 0, middle = 0;
    int count = 0;
    for (int unit = 1; unit <= units; ++unit) {
        shot.random_key = static_cast<std::uint64_t>(unit);
        const Echogram e = renderer.render(shot, {});
        middle += test::beam_power(e, 60) / units;
        for (const double aside : asides) {
            const auto off = static_cast<std::size_t>(aside);
            beside += test::beam_power(e, 60 - off) + test::beam_power(e, 60 + off), count += 2;
        }
    }
    return beside / count / middle;
}

std::shared_ptr<const Scene> target_ahead() {
    const std::vector behind{test::floor_at(-500, 1, 1, -120)};
    return Scene::from_meshes(behind, std::vector{PointTarget{"target", {10, 0, 0}, 0}});
}

TEST(ArrayErrors, ATargetIsHeardBesideItAtTheFloor) {
    Renderer real(target_ahead(), test::water_of(1500), patterned(true)),
        ideal(target_ahead(), test::water_of(1500), patterned(false));
    const double with = beside_of(real), without = beside_of(ideal);
    EXPECT_NEAR(db(with - without), floor_level, 1);
    EXPECT_LT(db(without), floor_level - 6);
}

// Through sectors, which the far lobes of surfaces go through: as many beams hear the plate as it is wide.
TEST(ArrayErrors, APlateIsHeardBesideItAtTheFloor) {
    const double half_width = 10 * std::tan(deg_to_rad(3)), heard_as = rad_to_deg(1 / (74.6 * 0.735));
    const auto plate = scene_of({test::wall_at(10, half_width, -0.5, 0.5)});
    Renderer real(plate, test::water_of(1500), patterned(true)),
        ideal(plate, test::water_of(1500), patterned(false));
    EXPECT_NEAR(db(beside_of(real) - beside_of(ideal)), floor_level + db(6 / heard_as), 1);
}

TEST(ArrayErrors, AreTheSameAtEveryPingAndAUnitsOwn) {
    Renderer renderer(target_ahead(), test::water_of(1500), patterned(true));
    Shot shot = fan();
    shot.errors.unit = 4711;
    const Echogram first = renderer.render(shot, {});
    shot.ping = 5, shot.random_key = 99;
    EXPECT_EQ(renderer.render(shot, {}).values, first.values) << "a unit with a number";
    shot.errors.unit = 4712;
    EXPECT_NE(renderer.render(shot, {}).values, first.values);
}

TEST(ArrayErrors, AnIdealArrayAndASingleBeamHaveNone) {
    Renderer real(target_ahead(), test::water_of(1500), patterned(true)),
        ideal(target_ahead(), test::water_of(1500), patterned(false));
    Shot shot = fan();
    shot.errors = {};
    EXPECT_EQ(real.render(shot, {}).values, ideal.render(shot, {}).values);
    shot = fan();
    shot.bearings = {0};
    EXPECT_EQ(real.render(shot, {}).values, ideal.render(shot, {}).values);
}

}  // namespace
}  // namespace echoloop
