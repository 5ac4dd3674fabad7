// How loud echoes are: closed forms of the radiometric rule.
#include <gtest/gtest.h>

#include <numbers>

#include "tests/render/meshes.h"
#include "tests/render/shots.h"

namespace echoloop {
namespace {

using test::db;
using test::scene_of;

/// Power in dB of one bin of a flat Lambert floor, integrated over ground range r: SL mu cos^2(i) R^-4
/// e^(-4aR) dA with cos i = H / R, dA = phi r dr and r dr = R dR.
double floor_level(const Shot& shot, double altitude, double mu_db, double absorption, double near,
                   double far) {
    constexpr int steps = 1000;
    double sum = 0;
    for (int i = 0; i < steps; ++i) {
        const double range = near + (far - near) * (i + 0.5) / steps;
        sum += std::pow(altitude / range, 2) * std::pow(range, -3) * std::exp(-4 * absorption * range);
    }
    return shot.source_level + mu_db + db(shot.beam_width * sum * (far - near) / steps);
}

// Without tilt a slice of bearing in the fan is the same slice on the floor, so all beams hear the same.
TEST(Level, FlatFloorFollowsTheIntegral) {
    const double altitude = 5, mu_db = -27, bin = 0.1;
    const Water water = test::water_of(1500);
    Renderer renderer(scene_of({test::floor_at(-altitude, 300, 1, mu_db)}), water, test::boxes());
    const Shot shot = test::fan(120, 80, 60, 500, 50);
    const Echogram e = renderer.render(shot, {});
    for (const std::size_t beam : {0U, 7U, 30U, 59U})
        for (std::size_t i = 85; i < 490; ++i) {
            const double near = static_cast<double>(i) * bin;
            const double expected =
                floor_level(shot, altitude, mu_db, test::nepers(water, shot.frequency), near, near + bin);
            EXPECT_NEAR(db(e.beam(beam)[i]), expected, 0.03) << "beam " << beam << " bin " << i;
        }
}

// V7 gives these for an insonified patch of (c tau / 2) phi R / cos g; here the patch is one bin of the same
// length.
TEST(Level, FlatFloorOfTheReferenceTable) {
    const Water water = test::water_of(1500);
    Renderer renderer(scene_of({test::floor_at(-5, 300)}), water, test::boxes());
    Shot shot = test::fan(1, 40, 1, 600, 45);  // bins of 75 mm: c tau / 2 at 100 us
    shot.tilt = deg_to_rad(-22);
    const Echogram e = renderer.render(shot, {});
    for (const auto& [range, level] : {std::pair{10.0, -91.23}, {20.0, -106.76}, {40.0, -121.92}}) {
        const auto bin = static_cast<std::size_t>(range / 0.075);
        const double two_way_db = 2 * absorption_db_per_km(water, shot.frequency) / 1000 * e.bin_range(bin);
        EXPECT_NEAR(db(e.beam(0)[bin]) + two_way_db - shot.source_level, level, 0.5) << range;
    }
}

// No stripes and no empty bins down to a grazing angle of one degree, whatever the tessellation.
TEST(Level, NoStripesOnAFlatFloorAtGrazingIncidence) {
    for (const int cells : {1, 200}) {
        const Water water = test::water_of(1500);
        Renderer renderer(scene_of({test::floor_at(-1, 60, cells)}), water, test::boxes());
        Shot shot = test::fan(20, 20, 40, 1000, 50);
        shot.tilt = deg_to_rad(-10);
        const Echogram e = renderer.render(shot, {});
        for (std::size_t i = 100; i < 950; ++i) {
            const double near = 0.05 * static_cast<double>(i);
            EXPECT_NEAR(db(e.beam(20)[i]),
                        floor_level(shot, 1, -27, test::nepers(water, shot.frequency), near, near + 0.05),
                        0.25)
                << "bin " << i << ", " << cells << " cells";
        }
    }
}

// V1 for a target of constant strength: level + 2 a R falls by 40 dB per decade.
TEST(Level, SmallTargetFallsWith40LogR) {
    const Water water = test::water_of(1500);
    const Shot shot = test::fan(6, 6, 1, 1200, 60);
    double n = 0, x = 0, y = 0, xx = 0, xy = 0;
    for (const double range : {2.0, 3.0, 5.0, 8.0, 13.0, 20.0, 30.0, 50.0}) {
        Renderer renderer(scene_of({test::wall_at(range, 0.05, -0.05, 0.05)}), water,
                          {.columns_per_beam = 64, .pixel_density = 16, .effects = test::boxes().effects});
        double power = 0;
        for (std::uint64_t ping = 0; ping < 32; ++ping) {
            Shot next = shot;
            next.ping = ping;
            power += test::total_power(renderer.render(next, {})) / 32;
        }
        const double level = db(power) + 2 * absorption_db_per_km(water, shot.frequency) / 1000 * range;
        const double decades = std::log10(range);
        ++n, x += decades, y += level, xx += decades * decades, xy += decades * level;
    }
    EXPECT_NEAR((n * xy - x * y) / (n * xx - x * x), -40.0, 0.3);
}

/// A sphere turned `aspect` times.
Mesh turned_sphere(Vec3 centre, double radius, int rings, double mu_db, int aspect) {
    Mesh mesh = test::sphere({}, radius, rings, mu_db);
    const Quat turn = axis_angle({0, 0, 1}, 1.1 * aspect) * axis_angle({0, 1, 0}, 0.7 * aspect);
    for (Vec3& p : mesh.positions) p = centre + rotate(turn, p);
    for (Vec3& n : mesh.normals) n = rotate(turn, n);
    return mesh;
}

// V6: a Lambert sphere has the target strength 10 log10(2 pi mu a^2 / 3) from every side, and a finer mesh
// does not change it. In the mean over pings, which sample it elsewhere each; a few pixels wide, it is drawn
// by few triangles.
TEST(Level, LambertSphere) {
    const double radius = 0.5, range = 50;
    constexpr int aspects = 8, pings = 8;
    const Water water = test::water_of(1500);
    Shot shot = test::fan(1.4, 1.4, 4, 300, 60);
    const double two_way_db =
        2 * transmission_loss(range, absorption_db_per_km(water, shot.frequency) / 1000);
    for (const auto& [mu_db, expected] : {std::pair{db(1 / std::numbers::pi), -7.78}, {-27.0, -29.81}})
        for (const int rings : {16, 32, 64}) {
            double mean = 0;
            for (int aspect = 0; aspect < aspects; ++aspect) {
                Renderer renderer(scene_of({turned_sphere({range, 0, 0}, radius, rings, mu_db, aspect)}),
                                  water, test::boxes());
                double power = 0;
                for (shot.ping = 0; shot.ping < pings; ++shot.ping)
                    power += test::total_power(renderer.render(shot, {})) / pings;
                const double strength = db(power) + two_way_db - shot.source_level;
                EXPECT_NEAR(strength, expected, 0.4) << rings << " rings, aspect " << aspect;
                mean += strength / aspects;
            }
            EXPECT_NEAR(mean, expected, 0.3) << rings << " rings";
        }
}

// A source that is 10 dB louder and a material that scatters 10 dB more each raise the echo by 10 dB.
TEST(Level, IsAbsolute) {
    Shot shot = test::fan(10, 10, 4, 100, 20);
    const double base = test::total_power(
        Renderer(scene_of({test::wall_at(10, 5, -5, 5, -27)}), {}, test::boxes()).render(shot, {}));
    const double rough = test::total_power(
        Renderer(scene_of({test::wall_at(10, 5, -5, 5, -17)}), {}, test::boxes()).render(shot, {}));
    shot.source_level += 10;
    const double loud = test::total_power(
        Renderer(scene_of({test::wall_at(10, 5, -5, 5, -27)}), {}, test::boxes()).render(shot, {}));
    EXPECT_NEAR(db(rough / base), 10, 1e-3);
    EXPECT_NEAR(db(loud / base), 10, 1e-3);
}

TEST(Level, DoesNotDependOnBinSize) {
    Renderer renderer(scene_of({test::floor_at(-5, 200), test::wall_at(20, 5, -5, 0)}), {}, test::boxes());
    Shot coarse = test::fan(20, 30, 10, 100, 40), fine = test::fan(20, 30, 10, 800, 40);
    coarse.tilt = fine.tilt = deg_to_rad(-16);
    EXPECT_NEAR(
        db(test::total_power(renderer.render(coarse, {})) / test::total_power(renderer.render(fine, {}))), 0,
        0.05);
}

// The paper's rule: the mean of the sigmoid, so a wall seen head-on has the same value at any range.
TEST(Level, CerqueiraHasNoRange) {
    const Shot shot = test::fan(1, 1, 1, 500, 50);
    for (const double range : {5.0, 20.0, 45.0}) {
        Renderer renderer(scene_of({test::wall_at(range, 5, -5, 5)}), {}, {.rule = EchoRule::cerqueira2016});
        const Echogram e = renderer.render(shot, {});
        EXPECT_EQ(e.rule, EchoRule::cerqueira2016);
        EXPECT_NEAR(e.beam(0)[test::strongest_bin(e.beam(0))], 1 / (1 + std::exp(-6.0)), 1e-3);
    }
}

}  // namespace
}  // namespace echoloop
