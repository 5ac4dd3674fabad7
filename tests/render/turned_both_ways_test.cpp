// Beams that send as they receive, while the sonar turns within a ping: what the sender's lobes and the
// receiver's have in common, of a fan's far lobes, of what lies above it, of the water, and of beams lower
// than the turn.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

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

/// One way's power of a plain line that is `width_deg` wide at -3 dB both ways.
double line(double width_deg, double off_deg) {
    const double x = 1.001906 * std::sin(deg_to_rad(off_deg)) / std::sin(deg_to_rad(width_deg / 2));
    return std::abs(x) < 1e-9 ? 1 : std::pow(std::sin(x) / x, 2);
}

/// dB, what beams from `first` to `last` deg off something lose of it when it is seen `turned_deg` nearer.
double lost(double width_deg, double first, double last, double turned_deg) {
    double still = 0, turned = 0;
    for (double off = first; off < last; off += width_deg / 100) {
        const double sent = line(width_deg, off);
        still += sent * sent, turned += sent * line(width_deg, off - turned_deg);
    }
    return db(turned / still);
}

/// The same in the mean over beams that lie anywhere between two nulls of their lobes.
double lost_of_lobes(double width_deg, double first, double last, double turned_deg) {
    const double lobe = width_deg * std::numbers::pi / (2 * 1.001906);
    double still = 0, turned = 0;
    for (int part = 0; part < 40; ++part)
        for (double off = first + (part / 40.0 - 0.5) * lobe; off < last + (part / 40.0 - 0.5) * lobe;
             off += width_deg / 50) {
            const double sent = line(width_deg, off);
            still += sent * sent, turned += sent * line(width_deg, off - turned_deg);
        }
    return db(turned / still);
}

/// 50 beams of 1 deg as an acoustic lens forms them.
Shot lens() {
    Shot shot = test::fan(50, 20, 50, 500, 1.1 * range);
    shot.horizontal = {ApertureShape::line, 2};
    shot.vertical = {ApertureShape::line, 1};
    return shot;
}

/// By so many deg until an echo is back from `range`.
Situation yawing_by(double degrees) { return moving({}, {0, 0, 15 * degrees}); }

// Lobes that are shifted against each other by half their spacing miss each other, by all of it they fit
// again: far off, 2/3 + cos(2 pi L / lambda sin turned) / 3.
TEST(TurnedBothWays, FarLobesOfAFanHearWhatTheySentTo) {
    Renderer renderer(test::scene_of({plate(0, 0, 0.3)}), test::water_of(c), patterned());
    for (const double by : {0.7, 1.4, 2.0}) {
        const double still = heard_between(renderer, lens(), {}, 12, 22);
        EXPECT_NEAR(db(heard_between(renderer, lens(), yawing_by(by), 12, 22) / still),
                    lost_of_lobes(1, 12, 22, by), 0.5)
            << by;
    }
}

// Through main lobes, of which the turned one misses what the other sent.
TEST(TurnedBothWays, WhatIsAboveAFanIsLostAsWhatIsAhead) {
    for (const double elevation : {-30.0, 20.0}) {
        Renderer renderer(test::scene_of({plate(0, elevation, 2)}), test::water_of(c), patterned());
        for (const double by : {0.5, 1.0}) {
            const double turned =
                rad_to_deg(std::asin(std::sin(deg_to_rad(by)) * std::cos(deg_to_rad(elevation))));
            const double still = heard_between(renderer, lens(), {}, -20, 20);
            EXPECT_NEAR(db(heard_between(renderer, lens(), yawing_by(by), -20, 20) / still),
                        lost(1, -20, 20, turned), 0.3)
                << elevation << ' ' << by;
        }
    }
}

TEST(TurnedBothWays, AFanLosesOfTheWaterAsOfAWall) {
    Water water = test::water_of(c);
    water.scattering = {{0, -50}};
    RendererOptions options = patterned();
    options.effects.set(Effect::reverberation);
    options.surface.reset();
    Renderer renderer(test::scene_of({test::wall_at(-500, 1, -1, 1)}), water, options);
    const Echogram still = renderer.render(lens(), {}), turned = renderer.render(lens(), yawing_by(1));
    for (const std::size_t beam : {15U, 25U, 35U})
        for (const double at : {25.0, 50.0}) {
            const auto bin = static_cast<std::size_t>(at / 55 * 500);
            EXPECT_NEAR(db(turned.beam(beam)[bin] / still.beam(beam)[bin]), lost(1, -25, 25, at / range), 0.2)
                << beam << ' ' << at;
        }
}

// A wall that fills the view, heard by beams no higher than the turn.
TEST(TurnedBothWays, AFlatBeamThatPitchesLosesWhatBothWaysMiss) {
    Renderer renderer(test::scene_of({test::wall_at(50, 60, -60, 60)}), test::water_of(c), patterned());
    for (const auto& [width, height] : {std::pair{4.0, 2.0}, {4.0, 3.0}, {2.0, 4.0}, {2.0, 2.0}}) {
        Shot shot = test::fan(width, height, 1, 200, 55);
        const auto level = [&](const Situation& situation) {
            double sum = 0;
            for (shot.ping = 0; shot.ping < 64; ++shot.ping)
                ++shot.random_key, sum += test::total_power(renderer.render(shot, situation));
            return sum;
        };
        const double still = level({});
        EXPECT_NEAR(db(level(moving({}, {0, 30, 0})) / still), lost(height, -40, 40, 2), 0.2)
            << width << " x " << height << " pitching";
        EXPECT_NEAR(db(level(moving({}, {0, 0, 30})) / still), lost(width, -40, 40, 2), 0.2)
            << width << " x " << height << " yawing";
    }
}

}  // namespace
}  // namespace echoloop
