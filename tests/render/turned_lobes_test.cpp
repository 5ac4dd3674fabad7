// What side lobes hear while the sonar turns within a ping: from beside and above the beams, far off the
// axis, by mirrors, and at the edges of what is drawn finely.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "render/acoustics/pattern.h"
#include "tests/render/meshes.h"
#include "tests/render/ping_motions.h"

namespace echoloop {
namespace {

using test::db;
using test::heard_between;
using test::moving;
using test::patterned;
using test::plate;

constexpr double c = 1500, range = test::range_of_plates;

/// By 2 deg until an echo is back from `range`.
const Situation yawing = moving({}, {0, 0, 30}), pitching = moving({}, {0, 30, 0});

Shot fan(double aperture_deg) {
    Shot shot = test::fan(aperture_deg, 20, static_cast<std::size_t>(aperture_deg), 500, 1.1 * range);
    shot.horizontal = {ApertureShape::hamming, 1};
    shot.vertical = {ApertureShape::line, 1};
    return shot;
}

/// deg, the middle of what the beams hear in so many pings.
double middle_of(Renderer& renderer, Shot shot, const Situation& situation, std::uint64_t pings = 1) {
    double sum = 0, moment = 0;
    for (shot.ping = 0; shot.ping < pings; ++shot.ping) {
        const Echogram e = renderer.render(shot, situation);
        for (std::size_t beam = 0; beam < e.beams(); ++beam) {
            const double power = test::beam_power(e, beam);
            sum += power, moment += power * rad_to_deg(shot.bearings[beam % shot.bearings.size()]);
        }
    }
    return moment / sum;
}

/// deg, by which a yaw of 2 deg turns what a line array hears from that elevation: its cones.
double turned_at(double elevation_deg) {
    return rad_to_deg(std::asin(std::sin(deg_to_rad(2)) * std::cos(deg_to_rad(elevation_deg))));
}

TEST(TurnedLobes, WhatIsAboveAFanIsHeardElsewhereWhenTheEchoComes) {
    for (const double elevation : {-50.0, 35.0}) {
        Renderer renderer(test::scene_of({plate(0, elevation, 2)}), test::water_of(c), patterned());
        const double still = middle_of(renderer, fan(24), {});
        EXPECT_NEAR(middle_of(renderer, fan(24), yawing) - still, turned_at(elevation), 0.05);
        EXPECT_NEAR(middle_of(renderer, fan(24), moving({}, {0, 0, -30})) - still, -turned_at(elevation),
                    0.05);
        // A roll by 2 deg moves what is so far above to the side.
        const double side = rad_to_deg(std::asin(std::sin(deg_to_rad(2)) * std::sin(deg_to_rad(-elevation))));
        EXPECT_NEAR(middle_of(renderer, fan(24), moving({}, {30, 0, 0})) - still, side, 0.05);
    }
}

// Far side lobes of a plain line fall as 1 / sin^2.
TEST(TurnedLobes, FarLobesHearATargetWhereItIsSeenThen) {
    Renderer renderer(test::scene_of({plate(0, 0, 0.3)}), test::water_of(c), patterned());
    Shot shot = fan(50);
    shot.horizontal.shape = ApertureShape::line;
    for (const double side : {-1, 1}) {
        const double first = side < 0 ? -21 : 15, last = side < 0 ? -15 : 21;
        double before = 0, then = 0;
        for (double bearing = first + 0.5; bearing < last; ++bearing) {
            before += std::pow(std::sin(deg_to_rad(bearing)), -2);
            then += std::pow(std::sin(deg_to_rad(bearing - 2)), -2);
        }
        const double still = heard_between(renderer, shot, {}, first, last);
        EXPECT_NEAR(db(heard_between(renderer, shot, yawing, first, last) / still), db(then / before), 0.2)
            << side;
    }
}

// What lies beside the outermost beam when it is lit, and before it when the echo comes, is as loud as what
// stays there, though it is not drawn finely.
TEST(TurnedLobes, WhatComesIntoAFanIsHeardByItsBeams) {
    const auto heard = [](double bearing_deg, const Situation& situation) {
        Renderer renderer(test::scene_of({plate(bearing_deg, 0, 2)}), test::water_of(c), patterned());
        double sum = 0;
        for (Shot shot = fan(24); shot.ping < 16; ++shot.ping)
            sum += test::total_power(renderer.render(shot, situation));
        return sum;
    };
    const Situation twice = moving({}, {0, 0, 90});  // 6 deg
    const double inside = heard(-9, {});
    EXPECT_LT(db(heard(-15, {}) / inside), -20);
    EXPECT_NEAR(db(heard(-15, twice) / inside), 0, 1);
    EXPECT_NEAR(db(heard(-9, twice) / inside), 0, 0.3);
    EXPECT_LT(db(heard(9, twice) / inside), -15) << "it has left the fan";
}

// And as sharp: what is seen in one beam by then is not spread over a sector of 3 deg.
TEST(TurnedLobes, WhatComesIntoAFanIsSharp) {
    const auto share_of_loudest = [](double bearing_deg, const Situation& situation) {
        Renderer renderer(test::scene_of({plate(bearing_deg, 0, 0.1)}), test::water_of(c), patterned());
        std::vector<double> heard(24);
        double sum = 0;
        for (Shot shot = fan(24); shot.ping < 32; ++shot.ping) {
            const Echogram e = renderer.render(shot, situation);
            for (std::size_t beam = 0; beam < e.beams(); ++beam)
                heard[beam] += test::beam_power(e, beam), sum += test::beam_power(e, beam);
        }
        const auto loudest = std::ranges::max_element(heard);
        return std::pair(loudest - heard.begin(), *loudest / sum);
    };
    const auto [there, still] = share_of_loudest(-10.5, {});
    EXPECT_GT(still, 0.7);
    for (const double by : {2.0, 4.0}) {
        const auto [beam, share] = share_of_loudest(-10.5 - by, moving({}, {0, 0, 15 * by}));
        EXPECT_EQ(beam, there) << by;
        EXPECT_NEAR(share, still, 0.1) << by;
    }
}

/// One way's power of a plain line or a piston that is `width` rad wide at -3 dB both ways.
double power_of(ApertureShape shape, double width, double off) {
    const double half = std::sin(width / 2), x = std::sin(off) / half;
    if (std::abs(x) < 1e-9) return 1;
    if (shape == ApertureShape::line) return std::pow(std::sin(1.001906 * x) / (1.001906 * x), 2);
    return std::pow(2 * std::cyl_bessel_j(1, 1.162 * std::abs(x)) / (1.162 * std::abs(x)), 2);
}

/// dB, by how much louder a single beam hears a plate that is `first` to `last` deg off its axis, when that
/// is seen `turned_deg` nearer to it at the end.
double louder(ApertureShape shape, double width, double first, double last, double turned_deg) {
    double still = 0, turned = 0;
    for (double off = first; off < last; off += 0.01) {
        const double sent = power_of(shape, width, deg_to_rad(off));
        still += sent * sent, turned += sent * power_of(shape, width, deg_to_rad(off - turned_deg));
    }
    return db(turned / still);
}

/// dB, the same of what a renderer hears in the mean over directions, upwards or to starboard.
double rendered(Shot shot, const Situation& situation, bool upwards, double first, double last) {
    Renderer renderer(test::scene_of({plate(0, 0, 0.5)}), test::water_of(c), patterned());
    double still = 0, turned = 0;
    for (double off = first; off < last; off += 0.04) {
        (upwards ? shot.tilt : shot.pan) = deg_to_rad(upwards ? -off : off);
        ++shot.random_key;  // other places within pixels
        still += test::total_power(renderer.render(shot, {}));
        turned += test::total_power(renderer.render(shot, situation));
    }
    return db(turned / still);
}

// A head's side lobes are narrower than what the pixels far off its axis show: they fit each other again and
// again as the receiver's are turned against the sender's, and not at all in between.
TEST(TurnedLobes, AHeadsSideLobesAreThoseOfBothWays) {
    for (const auto shape : {ApertureShape::line, ApertureShape::piston}) {
        Shot shot = test::fan(1.2, 20, 1, 200, 1.1 * range);
        shot.horizontal.shape = shot.vertical.shape = shape;
        if (shape == ApertureShape::piston) shot.fan_height = shot.beam_width;
        const double width = shot.beam_width;
        EXPECT_NEAR(rendered(shot, yawing, false, 8, 18), louder(shape, width, 8, 18, 2), 1);
        EXPECT_NEAR(rendered(shot, moving({}, {0, 0, -30}), false, 8, 18), louder(shape, width, 8, 18, -2),
                    1);
        shot.fan_height = shot.beam_width;
        EXPECT_NEAR(rendered(shot, pitching, true, 8, 18), louder(shape, width, 8, 18, -2), 1);
    }
}

// Axes are those of the beam, wherever it looks.
TEST(TurnedLobes, ABeamToTheSideTurnsAsOneAhead) {
    const auto changed = [](double axis_deg, bool upwards) {
        Renderer renderer(test::scene_of({plate(axis_deg + 10, 25, 2)}), test::water_of(c), patterned());
        Shot shot = test::fan(3, 20, 1, 200, 1.1 * range);
        const double axis = deg_to_rad(axis_deg);
        shot.bearings = {axis};
        const Vec3 turning = upwards ? Vec3{30 * std::sin(axis), 30 * std::cos(axis), 0} : Vec3{0, 0, 30};
        return db(test::total_power(renderer.render(shot, moving({}, turning))) /
                  test::total_power(renderer.render(shot, {})));
    };
    for (const bool upwards : {false, true}) {
        EXPECT_LT(changed(0, upwards), -2);
        for (const double axis : {-90, 60})
            EXPECT_NEAR(changed(axis, upwards), changed(0, upwards), 0.02) << axis;
    }
}

// By way of the water's surface: the bearing at which an echo arrives is turned once.
TEST(TurnedLobes, WhatAMirrorShowsIsTurnedOnce) {
    RendererOptions options = patterned();
    options.effects.set(Effect::multipath);
    options.surface = WaterSurface{5, 0};
    Mesh matt = plate(0, 0, 1);
    matt.material.reflection = 0;
    Renderer renderer(test::scene_of({matt}), test::water_of(c), options);
    Shot shot = fan(24);
    shot.fan_height = deg_to_rad(40);
    shot.first_bin_time = 2 * (range + 0.2) / c, shot.bins = 100, shot.bin_interval = 2 * 0.02 / c;
    const auto middle = [&](const Situation& situation) { return middle_of(renderer, shot, situation, 256); };
    EXPECT_NEAR(middle(yawing) - middle({}), 2, 0.1);
}

/// 24 x 20 beams of 1.5 deg.
Shot rows_of_beams() {
    Shot shot = test::fan(24, 2, 24, 400, 1.1 * range);
    for (int row = -10; row <= 10; ++row) shot.elevations.push_back(deg_to_rad(row));
    shot.beam_width = shot.fan_height = deg_to_rad(1.5);
    shot.horizontal = shot.vertical = {ApertureShape::line, 1};
    return shot;
}

TEST(TurnedLobes, WhatIsAboveRowsOfBeamsIsHeardElsewhere) {
    for (const double side : {-1, 1}) {
        Renderer renderer(test::scene_of({plate(-side, 35, 1.5)}), test::water_of(c), patterned());
        const auto middle = [&](const Situation& situation) {
            double sum = 0;
            for (Shot shot = rows_of_beams(); shot.random_key < 32; ++shot.random_key)
                sum += middle_of(renderer, shot, situation, 2);
            return sum / 32;
        };
        EXPECT_NEAR(middle(moving({}, {0, 0, side * 30})) - middle({}), side * turned_at(35), 0.15);
    }
}

// By main lobes, and by those of other beams that are far off.
TEST(TurnedLobes, WhatComesIntoRowsOfBeamsIsHeardByThem) {
    const auto heard_from = [](double first_deg, double bearing_deg, const Situation& situation) {
        Renderer renderer(test::scene_of({plate(bearing_deg, 0, 2)}), test::water_of(c), patterned());
        double sum = 0;
        for (Shot shot = rows_of_beams(); shot.ping < 32; ++shot.ping, ++shot.random_key) {
            const Echogram e = renderer.render(shot, situation);
            for (std::size_t beam = 0; beam < e.beams(); ++beam)
                if (shot.bearings[beam % shot.bearings.size()] > deg_to_rad(first_deg))
                    sum += test::beam_power(e, beam);
        }
        return sum;
    };
    const auto heard = [&](double bearing_deg, const Situation& situation) {
        return heard_from(-90, bearing_deg, situation);
    };
    const Situation by_6_deg = moving({}, {0, 0, 90});
    const double inside = heard(-9, {});
    EXPECT_LT(db(heard(-17, {}) / inside), -10);
    EXPECT_NEAR(db(heard(-15, by_6_deg) / inside), 0, 0.3);
    EXPECT_NEAR(db(heard_from(2, -15, by_6_deg) / heard_from(2, -9, {})), 0, 1);
    EXPECT_LT(db(heard(9, by_6_deg) / inside), -10) << "it has left the field";
}

}  // namespace
}  // namespace echoloop
