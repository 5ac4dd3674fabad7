// A single beam's pattern off both of its axes: on a floor below a tall beam, around a wide piston, and on
// targets.
#include <gtest/gtest.h>

#include <numbers>

#include "tests/render/meshes.h"
#include "tests/render/shots.h"

namespace echoloop {
namespace {

using std::numbers::pi;
using test::db;
using test::scene_of;

constexpr double mu_db = -27;

RendererOptions patterned() {
    RendererOptions options;
    options.effects =
        Effects::none().set(Effect::spreading).set(Effect::beam_pattern).set(Effect::side_lobes);
    return options;
}

double jinc(double x) { return std::abs(x) < 1e-9 ? 1 : 2 * std::cyl_bessel_j(1, std::abs(x)) / std::abs(x); }
double sinc(double x) { return std::abs(x) < 1e-9 ? 1 : std::sin(x) / x; }

/// An aperture that transmits and receives, from the textbook and not from the renderer: two-way power.
struct Aperture {
    ApertureShape shape;
    double width, height;  ///< rad, -3 dB full widths of both ways

    /// `d`: unit, x along the axis.
    double power(Vec3 d) const {
        if (d.x <= 0) return 0;
        // sinc(x)^4 is a half at x = 1.001906, (2 J1(x) / x)^4 at 1.160286.
        if (shape == ApertureShape::piston)
            return std::pow(jinc(1.160286 / std::sin(width / 2) * std::hypot(d.y, d.z)), 4);
        return std::pow(
            sinc(1.001906 / std::sin(width / 2) * d.y) * sinc(1.001906 / std::sin(height / 2) * d.z), 4);
    }
};

Shot beam(const Aperture& aperture) {
    Shot shot = test::fan(rad_to_deg(aperture.width), rad_to_deg(aperture.height), 1, 300, 30);
    shot.horizontal = shot.vertical = {aperture.shape, 2};
    return shot;
}

/// dB re the source: a bin of a floor `altitude` m below, from `near` to `far` m: mu cos^2(i) R^-4 times the
/// pattern, over the area R dR dphi.
double floor_level(const Aperture& aperture, double tilt, double altitude, double near, double far) {
    constexpr int ranges = 20, turns = 20000;
    double sum = 0;
    for (int r = 0; r < ranges; ++r) {
        const double range = near + (far - near) * (r + 0.5) / ranges, down = altitude / range;
        for (int i = 0; i < turns; ++i) {
            const double phi = 2 * pi * i / turns, level = std::sqrt(1 - down * down);
            const Vec3 d = rotate(axis_angle({0, 1, 0}, tilt),
                                  Vec3{level * std::cos(phi), level * std::sin(phi), -down});
            sum += aperture.power(d) * down * down * std::pow(range, -3) * (far - near) / ranges * 2 * pi /
                   turns;
        }
    }
    return mu_db + db(sum);
}

/// Compares the bins from `first` to `last` m, mean of 32 pings.
void expect_floor(const Aperture& aperture, double tilt, double first, double last, double tolerance) {
    constexpr double altitude = 10, bin = 0.1;
    constexpr int pings = 32;
    Renderer renderer(scene_of({test::floor_at(-altitude, 400, 1, mu_db)}), test::water_of(1500),
                      patterned());
    Shot shot = beam(aperture);
    shot.tilt = tilt;
    std::vector<double> mean(shot.bins);
    for (; shot.ping < pings; ++shot.ping) {
        shot.random_key = shot.ping;  // moves the samples that side lobes hear
        const Echogram e = renderer.render(shot, {});
        for (std::size_t i = 0; i < shot.bins; ++i) mean[i] += e.values[i] / double{pings};
    }
    for (double near = first; near < last; near += 1) {
        const auto i = static_cast<std::size_t>(std::lround(near / bin));
        EXPECT_NEAR(db(mean[i]) - shot.source_level, floor_level(aperture, tilt, altitude, near, near + bin),
                    tolerance)
            << "at " << near << " m, tilt " << rad_to_deg(tilt) << " deg";
    }
}

constexpr double none = 0;

// A bearing's slice of what lies high or low in a tall beam is narrow, and the beam as much wider there.
TEST(SingleBeam, TallLineBeamHearsAFloorByItsCone) {
    expect_floor({ApertureShape::line, deg_to_rad(3), deg_to_rad(35)}, none, 14, 29, 0.3);
    expect_floor({ApertureShape::line, deg_to_rad(0.5), deg_to_rad(50)}, none, 13, 29, 0.3);
    expect_floor({ApertureShape::line, deg_to_rad(0.5), deg_to_rad(50)}, deg_to_rad(-30), 12, 29, 0.3);
}

// 25 deg need more than one view.
TEST(SingleBeam, WidePistonHearsAFloorByTheAngleOffItsAxis) {
    const Aperture disc{ApertureShape::piston, deg_to_rad(25), deg_to_rad(25)};
    expect_floor(disc, deg_to_rad(-90), 10.1, 12, 0.3);
    expect_floor(disc, deg_to_rad(-60), 11, 16, 0.3);
    expect_floor(disc, deg_to_rad(-30), 14, 29, 0.3);
}

double heard_of(const std::shared_ptr<const Scene>& scene, const Aperture& aperture, double turn,
                double tilt) {
    Renderer renderer(scene, test::water_of(1500), patterned());
    Shot shot = beam(aperture);
    shot.pan = turn;
    shot.tilt = tilt;
    double sum = 0;
    for (; shot.ping < 32; ++shot.ping) {
        shot.random_key = shot.ping;
        sum += test::total_power(renderer.render(shot, {}));
    }
    return db(sum / 32);
}

TEST(SingleBeam, WidePistonTurnedFromABallFallsAsOneTilted) {
    const Aperture disc{ApertureShape::piston, deg_to_rad(25), deg_to_rad(25)};
    const auto ball = scene_of({test::sphere({10, 0, 0}, 0.4, 24, mu_db)});
    const double axis = heard_of(ball, disc, 0, 0);
    for (const double off : {5.0, 12.5, 20.0, 30.0}) {
        const double angle = deg_to_rad(off);
        const double expected = db(disc.power({std::cos(angle), std::sin(angle), 0}));
        EXPECT_NEAR(heard_of(ball, disc, angle, 0) - axis, expected, 0.5) << off << " deg turned";
        EXPECT_NEAR(heard_of(ball, disc, 0, angle) - axis, expected, 0.5) << off << " deg tilted";
    }
}

TEST(SingleBeam, TargetOffBothAxesIsHeardByTheAperture) {
    for (const Aperture& aperture : {Aperture{ApertureShape::piston, deg_to_rad(25), deg_to_rad(25)},
                                     Aperture{ApertureShape::line, deg_to_rad(3), deg_to_rad(35)}})
        for (const auto& [bearing, elevation] :
             {std::pair{0.0, 10.0}, {2.0, 30.0}, {6.0, 50.0}, {40.0, 30.0}}) {
            const double b = deg_to_rad(bearing), e = deg_to_rad(elevation);
            const Vec3 d{std::cos(e) * std::cos(b), -std::cos(e) * std::sin(b), std::sin(e)};
            const std::vector behind{test::floor_at(-500, 1, 1, -120)};
            const auto target = Scene::from_meshes(behind, std::vector{PointTarget{"target", 10 * d, -20}});
            EXPECT_NEAR(heard_of(target, aperture, 0, 0) - 200 + 20 + 40, db(aperture.power(d)), 0.1)
                << bearing << " deg beside, " << elevation << " deg up";
        }
}

}  // namespace
}  // namespace echoloop
