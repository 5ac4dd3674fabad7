// What floats in the water and its surface in the wind, against closed forms, and that nothing but that is
// new at every ping.
#include <gtest/gtest.h>

#include <numbers>

#include "render/acoustics/sea_surface.h"
#include "tests/render/meshes.h"
#include "tests/render/shots.h"

namespace echoloop {
namespace {

using test::db;
using test::scene_of;

constexpr double c = 1490;

Water sea(std::vector<ScatteringPoint> scattering) {
    Water water = test::water_of(c);
    water.scattering = std::move(scattering);
    return water;
}

/// Mean levels with pulse and patterns, and no surface unless it is given.
RendererOptions means(std::optional<WaterSurface> surface = {}) {
    RendererOptions options = test::boxes();
    for (const Effect effect :
         {Effect::beam_pattern, Effect::side_lobes, Effect::pulse, Effect::reverberation})
        options.effects.set(effect);
    options.surface = surface;
    return options;
}

/// A line of 3 x 35 deg one way, 2.16 x 25.0 both ways, level, 100 us at 700 kHz, bins of 50 mm.
Shot head(std::size_t bins = 500) {
    Shot shot = test::fan(2.16, 25.0, 1, bins, 0.05 * static_cast<double>(bins), c);
    shot.frequency = 700e3, shot.pulse_length = 100e-6;
    return shot;
}

/// Nothing in the way: one small wall behind the sonar.
std::shared_ptr<const Scene> open_water() { return scene_of({test::wall_at(-500, 1, -1, 1)}); }

double level_at(const Echogram& e, double range, std::size_t beam = 0) {
    return db(e.beam(beam)[static_cast<std::size_t>(range / (c / 2 * e.shot.bin_interval))]);
}

/// RL - SL of Sv over range: Sv + 10 log (c tau / 2) - 20 log R - 2 a R + 10 log Psi.
double volume_level(const Shot& shot, const Water& water, double strength, double psi, double range) {
    const double a = absorption_db_per_km(water, shot.frequency) / 1000;
    return strength + db(c * shot.pulse_length / 2 * psi) - 20 * std::log10(range) - 2 * a * range;
}

// A line's two-way equivalent width is 0.7526 times its one-way width, or 1.045 times its two-way width.
TEST(Reverberation, VolumeFallsWithRangeAsUrickSays) {
    const Water water = sea({{0, -60}});
    Renderer renderer(open_water(), water, means());
    const Echogram e = renderer.render(head(), {});
    const double psi = std::pow(10, -1.749);
    for (const double range : {2.0, 5.0, 10.0, 20.0})
        EXPECT_NEAR(level_at(e, range) - 200, volume_level(e.shot, water, -60, psi, range), 0.3) << range;
}

// Of a line that sends and receives, L long: the integral of |p|^4 over a slice of Fresnel's field of a line
// over that of its far field, at R = 0.2, 0.5, 1 and 2 times 0.52 wavelength / (one-way width)^2.
TEST(Reverberation, InTheNearFieldItGrowsMoreSlowly) {
    const Water water = sea({{0, -60}});
    Renderer renderer(open_water(), water, means());
    Shot shot = test::fan(2.16, 25.0, 1, 300, 1.2, c);
    shot.frequency = 700e3, shot.pulse_length = 5e-6;
    const Echogram e = renderer.render(shot, {});
    const double near = 0.52 * c / shot.frequency / std::pow(deg_to_rad(3.0), 2), psi = std::pow(10, -1.749);
    const std::pair<double, double> integral[] = {{0.2, -7.13}, {0.5, -3.14}, {1, -0.90}, {2, -0.23}};
    for (const auto& [part, less] : integral)
        EXPECT_NEAR(level_at(e, part * near) - 200, volume_level(shot, water, -60, psi, part * near) + less,
                    0.9)
            << part;
}

TEST(Reverberation, BeamsOfAFanHearTheirOwnWidthOfWater) {
    const Water water = sea({{0, -60}});
    Renderer renderer(open_water(), water, means());
    Shot shot = test::fan(90, 20, 90, 400, 20, c);
    const Echogram e = renderer.render(shot, {});
    const double psi = 1.045 * 1.045 * shot.beam_width * shot.fan_height;
    for (const std::size_t beam : {10U, 45U, 80U})
        for (const double range : {5.0, 15.0})
            EXPECT_NEAR(level_at(e, range, beam) - 200, volume_level(shot, water, -60, psi, range), 0.5)
                << beam << " at " << range;
}

TEST(Reverberation, RowsOfBeamsHearAsMuchAsAFan) {
    const Water water = sea({{0, -60}});
    Renderer renderer(open_water(), water, means());
    Shot shot = test::fan(40, 2, 40, 200, 10, c);
    for (double row = -10; row <= 10; row += 1) shot.elevations.push_back(deg_to_rad(row));
    shot.horizontal = shot.vertical = {ApertureShape::line, 2};
    const Echogram e = renderer.render(shot, {});
    const double psi = 1.045 * 1.045 * shot.beam_width * shot.fan_height;
    for (const std::size_t row : {3U, 10U, 17U})
        EXPECT_NEAR(level_at(e, 6, row * 40 + 20) - 200, volume_level(shot, water, -60, psi, 6), 0.5) << row;
}

TEST(Reverberation, AWallEndsIt) {
    Renderer renderer(scene_of({test::wall_at(8, 100, -100, 100, -119)}), sea({{0, -60}}), means());
    const Echogram e = renderer.render(head(), {});
    Renderer open(open_water(), sea({{0, -60}}), means());
    const Echogram far = open.render(head(), {});
    EXPECT_NEAR(level_at(e, 6), level_at(far, 6), 0.05);
    EXPECT_LT(level_at(e, 24), level_at(far, 24) - 20) << "only beside the beam there is water beyond 20 m";
}

TEST(Reverberation, LayersScatterAtTheirDepth) {
    // A cloud from 8 to 12 m below a sonar that looks straight down from 2 m.
    Water water = sea({{0, -90}, {9.9, -90}, {10, -50}, {14, -50}, {14.1, -90}});
    water.depth = 2;
    Renderer renderer(open_water(), water, means());
    Shot shot = test::fan(5, 5, 1, 400, 20, c);
    shot.tilt = deg_to_rad(-90);
    const Echogram e = renderer.render(shot, {});
    const double psi = 1.045 * 1.045 * shot.beam_width * shot.fan_height;
    EXPECT_NEAR(level_at(e, 10) - 200, volume_level(shot, water, -50, psi, 10), 0.5);
    EXPECT_LT(level_at(e, 6), level_at(e, 10) - 25);
    EXPECT_LT(level_at(e, 14), level_at(e, 10) - 25);
}

TEST(Reverberation, BubblesAreThoseOfTheHandbook) {
    const auto level = [](double khz, double wind, double grazing) {
        return db(bubble_backscatter(khz * 1e3, wind, std::sin(deg_to_rad(grazing))));
    };
    const double grazing[] = {5, 10, 30, 60};
    const struct {
        double khz, wind, levels[4], loss;
    } table[] = {{100, 8, {-31.27, -27.28, -24.21, -23.48}, 3.31},
                 {700, 3, {-41.84, -41.72, -41.64, -41.62}, 0.30},
                 {700, 5, {-34.23, -33.23, -32.56, -32.41}, 3.31},
                 {700, 12, {-36.81, -33.82, -29.23, -26.84}, 32.7}};
    for (const auto& row : table) {
        for (std::size_t i = 0; i < 4; ++i)
            EXPECT_NEAR(level(row.khz, row.wind, grazing[i]), row.levels[i], 0.1) << row.wind;
        if (row.khz > 100 || row.wind == 8) {
            EXPECT_NEAR(surface_bubble_loss_db(row.khz * 1e3, row.wind, 0.5), row.loss, 0.1) << row.wind;
        }
    }
}

// V26: a head 1 m below the surface.
TEST(Reverberation, TheSurfaceInTheWindIsAsLoudAsItsLaw) {
    const auto levels = [](double wind) {
        Renderer renderer(open_water(), sea({}), means(WaterSurface{.height = 1, .wind = wind}));
        const Echogram e = renderer.render(head(), {});
        std::vector<double> out;
        for (const double range : {2.0, 5.0, 10.0, 20.0}) out.push_back(level_at(e, range) - 200);
        return out;
    };
    const auto light = levels(3), fresh = levels(5);
    const double expected[] = {-96.0, -92.4, -101.7, -114.5};
    for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(light[i], expected[i], 1) << i;
    EXPECT_NEAR(fresh[0] - light[0], 9.1, 1);
    EXPECT_NEAR(fresh[3] - light[3], 6.3, 1);
}

TEST(Reverberation, TheSurfaceBeginsAtItsDistanceAndAHullHidesIt) {
    const auto surface = means(WaterSurface{.height = 3, .wind = 5});
    Renderer renderer(open_water(), sea({}), surface);
    const Echogram e = renderer.render(head(), {});
    EXPECT_GT(test::beam_power(e, 0), 0);
    for (std::size_t bin = 0; bin < 58; ++bin) EXPECT_EQ(e.beam(0)[bin], 0) << bin;
    // A plate right above the sonar, as wide as it looks: it is heard itself, but no surface beyond.
    Renderer hidden(scene_of({test::quad("hull", {-50, -50, 1}, {-50, 50, 1}, {50, 50, 1}, {50, -50, 1})}),
                    sea({}), surface);
    const Echogram below = hidden.render(head(), {});
    RendererOptions calm = surface;
    calm.effects.set(Effect::reverberation, false);
    Renderer without(scene_of({test::quad("hull", {-50, -50, 1}, {-50, 50, 1}, {50, 50, 1}, {50, -50, 1})}),
                     sea({}), calm);
    const Echogram expected = without.render(head(), {});
    EXPECT_NEAR(db(test::beam_power(below, 0)), db(test::beam_power(expected, 0)), 0.01);
}

/// Correlation of two lines of levels.
double correlation(std::span<const float> a, std::span<const float> b) {
    double ma = 0, mb = 0, aa = 0, bb = 0, ab = 0;
    const auto n = static_cast<double>(a.size());
    for (std::size_t i = 0; i < a.size(); ++i) ma += db(a[i]) / n, mb += db(b[i]) / n;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const double x = db(a[i]) - ma, y = db(b[i]) - mb;
        aa += x * x, bb += y * y, ab += x * y;
    }
    return ab / std::sqrt(aa * bb);
}

TEST(Reverberation, ItsSpeckleIsNewAtEveryPingAndTheFloorsIsNot) {
    RendererOptions options = means();
    options.effects.set(Effect::speckle);
    const auto two_pings = [&](const std::shared_ptr<const Scene>& scene,
                               std::vector<ScatteringPoint> points) {
        Renderer renderer(scene, sea(std::move(points)), options);
        Shot shot = head();
        shot.tilt = deg_to_rad(-30);
        const Echogram first = renderer.render(shot, {});
        shot.ping = 1;
        const Echogram second = renderer.render(shot, {});
        return correlation(first.beam(0).subspan(150, 300), second.beam(0).subspan(150, 300));
    };
    const auto floor = scene_of({test::floor_at(-5, 300)});
    EXPECT_GT(two_pings(floor, {{0, -90}}), 0.9);
    // Over 15 m the level itself falls, which correlates; speckle of 5.6 dB would make it nearly 1.
    EXPECT_LT(two_pings(open_water(), {{0, -60}}), 0.65);
}

TEST(Reverberation, OffNothingIsThere) {
    RendererOptions options = means(WaterSurface{.height = 1, .wind = 5});
    options.effects.set(Effect::reverberation, false);
    Renderer renderer(open_water(), sea({{0, -50}}), options);
    EXPECT_EQ(test::total_power(renderer.render(head(), {})), 0);
}

TEST(Reverberation, TheMeanOfAFloorStays) {
    const auto level = [](bool on) {
        RendererOptions options = means(WaterSurface{.height = 5, .wind = 1.5});
        options.effects.set(Effect::reverberation, on);
        Renderer renderer(scene_of({test::floor_at(-5, 300)}), sea({{0, -62}}), options);
        Shot shot = head();
        shot.tilt = deg_to_rad(-20);
        const Echogram e = renderer.render(shot, {});
        double sum = 0;
        for (std::size_t bin = 150; bin < 400; ++bin) sum += e.beam(0)[bin];
        return db(sum);
    };
    EXPECT_NEAR(level(true), level(false), 0.5);
}

TEST(Reverberation, BadWaterIsRefused) {
    EXPECT_THROW(validate(sea({{5, -60}, {5, -70}})), std::invalid_argument);
    EXPECT_THROW(validate(sea({{5, 3}})), std::invalid_argument);
    EXPECT_NO_THROW(validate(sea({{0, -60}, {5, -70}})));
}

}  // namespace
}  // namespace echoloop
