// A sonar that moves and turns while its ping is under way (V37, V38 of the reference values): directions and
// levels of a receiver that looks elsewhere by then, and ranges.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/render/meshes.h"
#include "tests/render/ping_motions.h"
#include "tests/render/shots.h"

namespace echoloop {
namespace {

using test::db;

using test::moving;
using test::patterned;

constexpr double c = 1500;

const Situation yawing = moving({}, {0, 0, 30});

/// Beams of 1 deg, every half a degree within +-10 deg, that transmit wide.
Shot imaging(double range) {
    Shot shot = test::fan(20, 20, 40, 400, 1.1 * range);
    shot.beam_width = deg_to_rad(1);
    shot.horizontal = {ApertureShape::hamming, 1};
    shot.vertical = {ApertureShape::line, 1};
    return shot;
}

/// A square plate that faces the sonar, `range` m away.
Mesh plate(double range, double half = 0.05) {
    Mesh mesh = test::wall_at(range, half, -half, half);
    mesh.object = "plate";
    return mesh;
}

std::shared_ptr<const Scene> target(double range) {
    return Scene::from_meshes(std::vector{test::wall_at(-500, 1, -1, 1)},
                              std::vector{PointTarget{"ball", {range, 0, 0}, -10}});
}

/// deg, the middle of what all beams hear, in the mean over pings.
double bearing_of(Renderer& renderer, Shot shot, const Situation& situation, int pings) {
    double sum = 0, moment = 0;
    for (int ping = 0; ping < pings; ++ping) {
        shot.ping = static_cast<std::uint64_t>(ping);
        const Echogram e = renderer.render(shot, situation);
        for (std::size_t beam = 0; beam < e.beams(); ++beam) {
            const double power = test::beam_power(e, beam);
            sum += power, moment += power * rad_to_deg(shot.bearings[beam % shot.bearings.size()]);
        }
    }
    return moment / sum;
}

// V37.
TEST(PingMotion, ABeamLooksElsewhereWhenTheEchoComes) {
    const std::pair<double, double> turned[] = {{10, 0.4}, {40, 1.6}, {50, 2.0}, {100, 4.0}};
    for (const auto& [range, degrees] : turned) {
        Renderer renderer(target(range), test::water_of(c), patterned());
        EXPECT_NEAR(bearing_of(renderer, imaging(range), yawing, 1), degrees, 0.02) << range;
        EXPECT_NEAR(bearing_of(renderer, imaging(range), {}, 1), 0, 1e-5) << range;  // deg, of sums of floats
    }
}

TEST(PingMotion, APictureIsSheared) {
    Renderer renderer(test::scene_of({plate(40)}), test::water_of(c), patterned());
    const double still = bearing_of(renderer, imaging(40), {}, 16),
                 turned = bearing_of(renderer, imaging(40), yawing, 16);
    EXPECT_NEAR(40 * deg_to_rad(turned - still), 1.117, 0.02);
    const double pitching = bearing_of(renderer, imaging(40), moving({}, {0, 30, 0}), 16);
    EXPECT_NEAR(pitching, still, 1e-3) << "the transmitter alone is flat";
}

TEST(PingMotion, AllBeamsKeepTheirLevelWhereTheyAreLit) {
    Renderer renderer(test::scene_of({test::wall_at(30, 60, -2, 2)}), test::water_of(c), patterned());
    Shot shot = imaging(32);
    std::vector<double> still(40), turned(40);
    for (; shot.ping < 32; ++shot.ping) {
        const Echogram a = renderer.render(shot, {}), b = renderer.render(shot, yawing);
        for (std::size_t beam = 0; beam < 40; ++beam)
            still[beam] += test::beam_power(a, beam), turned[beam] += test::beam_power(b, beam);
    }
    for (std::size_t beam = 5; beam < 35; ++beam) EXPECT_NEAR(db(turned[beam] / still[beam]), 0, 0.1) << beam;
}

/// A plain line that transmits and receives, 3 deg wide one way.
Shot head(double range) {
    Shot shot = test::fan(3 * 1.001906 / 1.391557, 20, 1, 200, range);
    return shot;
}

struct Heard {
    double bearing, loss;  ///< deg, dB
};

/// Where a head hears something loudest while the vehicle turns, and how much weaker than at rest.
Heard loudest(const std::shared_ptr<const Scene>& scene, int pings) {
    Renderer renderer(scene, test::water_of(c), patterned());
    Shot shot = head(55);
    const auto level = [&](double pan_deg, const Situation& situation) {
        double sum = 0;
        for (shot.ping = 0; shot.ping < static_cast<std::uint64_t>(pings); ++shot.ping) {
            shot.pan = deg_to_rad(pan_deg);
            sum += test::total_power(renderer.render(shot, situation));
        }
        return sum;
    };
    double best = 0, at = 0, first = 0, second = 0;
    for (double pan = -1; pan <= 3.001; pan += 0.25) {
        const double heard = level(pan, yawing);
        first += heard * pan, second += heard;
        if (heard > best) best = heard, at = pan;
    }
    EXPECT_NEAR(first / second, at, 0.25);
    return {at, db(best / level(0, {}))};
}

// V37: a vehicle that turns to port has a head hear best what it sent to by half of the turn to starboard.
TEST(PingMotion, AHeadHearsBestHalfWayAndLoses) {
    for (const auto& scene : {target(50), test::scene_of({plate(50)})}) {
        const Heard heard = loudest(scene, 16);
        EXPECT_NEAR(heard.bearing, 1.0, 0.1);
        EXPECT_NEAR(heard.loss, -2.57, 0.2);
    }
}

// V37: the integral of both patterns.
TEST(PingMotion, AHeadLosesOfWhatIsEverywhere) {
    Renderer renderer(test::scene_of({test::wall_at(50, 60, -1, 1)}), test::water_of(c), patterned());
    Shot shot = head(55);
    double still = 0, turned = 0;
    for (; shot.ping < 64; ++shot.ping) {
        still += test::total_power(renderer.render(shot, {}));
        turned += test::total_power(renderer.render(shot, yawing));
    }
    EXPECT_NEAR(db(turned / still), -3.02, 0.2);
}

/// dB, what a plain line of `width_deg` both ways loses of what is everywhere when it turns by `turn_deg`.
double loss_of_line(double width_deg, double turn_deg) {
    const auto power = [&](double off) {
        const double x = 1.001906 * off / (width_deg / 2);
        return std::abs(x) < 1e-9 ? 1 : std::pow(std::sin(x) / x, 2);
    };
    double still = 0, turned = 0;
    for (double off = -8 * width_deg; off < 8 * width_deg; off += width_deg / 100)
        still += power(off) * power(off), turned += power(off) * power(off - turn_deg);
    return db(turned / still);
}

// The same upwards, and for a piston both ways. The surround's pixels are coarse where they take over from
// the main lobe: beams no higher than the turn lose 0.6 dB too much.
TEST(PingMotion, AHeadThatPitchesLosesAsMuch) {
    EXPECT_NEAR(loss_of_line(3 * 1.001906 / 1.391557, 2), -3.02, 0.02) << "V37";
    for (const auto shape : {ApertureShape::line, ApertureShape::piston}) {
        Renderer renderer(test::scene_of({test::wall_at(50, 60, -60, 60)}), test::water_of(c), patterned());
        Shot shot = head(55);
        shot.beam_width = shot.fan_height = deg_to_rad(4);
        shot.horizontal.shape = shot.vertical.shape = shape;
        const auto level = [&](const Situation& situation) {
            double sum = 0;
            for (shot.ping = 0; shot.ping < 64; ++shot.ping)
                sum += test::total_power(renderer.render(shot, situation));
            return sum;
        };
        const double still = level({}), pitched = db(level(moving({}, {0, 30, 0})) / still);
        EXPECT_NEAR(pitched, db(level(yawing) / still), 0.25);
        EXPECT_NEAR(pitched, loss_of_line(4, 2), 0.2);
    }
}

/// m, the middle of what the beams hear.
double range_of(const Echogram& e) {
    double sum = 0, moment = 0;
    for (std::size_t beam = 0; beam < e.beams(); ++beam)
        for (std::size_t bin = 0; bin < e.shot.bins; ++bin) {
            const double power = e.beam(beam)[bin];
            sum += power, moment += power * e.bin_range(bin);
        }
    return moment / sum;
}

/// A window of bins of 2 mm, half a metre to both sides.
Shot around(double range) {
    Shot shot = imaging(range);
    shot.first_bin_time = 2 * (range - 0.5) / c, shot.bins = 500, shot.bin_interval = 2 * 0.002 / c;
    return shot;
}

// R v / c: the way back alone is shorter.
TEST(PingMotion, ASonarThatComesNearerHearsTheRangeHalfWay) {
    const Shot shot = around(50);
    for (const auto& scene : {test::scene_of({plate(50, 0.5)}), target(50)}) {
        Renderer renderer(scene, test::water_of(c), patterned()),
            still(scene, test::water_of(c), patterned(false));
        const double rest = range_of(renderer.render(shot, {}));
        EXPECT_NEAR(range_of(renderer.render(shot, moving({3, 0, 0}))) - rest, -0.1, 3e-3);
        EXPECT_NEAR(range_of(renderer.render(shot, moving({-3, 2, 0}))) - rest, 0.1, 3e-3);
        EXPECT_EQ(range_of(still.render(shot, moving({3, 0, 0}))), rest) << "the effect is off";
    }
}

// V38.
TEST(PingMotion, ASweepTakesWhatComesNearerForNearer) {
    const std::pair<std::pair<double, double>, double> sweeps[] = {{{12e-3, 10e3}, 0.360},
                                                                   {{4e-3, 40e3}, 0.0300}};
    for (const auto& [sweep, bias] : sweeps) {
        Shot shot = around(20);
        shot.frequency = 300e3, shot.pulse_length = sweep.first, shot.bandwidth = sweep.second;
        for (const auto& scene : {test::scene_of({plate(20, 0.5)}), target(20)}) {
            Renderer renderer(scene, test::water_of(c), patterned());
            const double rest = range_of(renderer.render(shot, {}));
            EXPECT_NEAR(rest - range_of(renderer.render(shot, moving({1, 0, 0}))), bias + 20.0 / c, 3e-3);
        }
    }
}

TEST(PingMotion, WhatIsTooLittleToMatterChangesNoByte) {
    Renderer renderer(test::scene_of({test::floor_at(-5, 60), test::box("box", {12, 1, -4}, {2, 2, 2})}),
                      test::water_of(c), patterned());
    for (const Shot& shot : {imaging(25), head(25)}) {
        const auto still = renderer.render(shot, {}).values;
        EXPECT_EQ(renderer.render(shot, moving({0.01, 0, 0}, {0, 0, 0.01})).values, still);
        EXPECT_NE(renderer.render(shot, moving({1, 0, 0})).values, still);
        EXPECT_NE(renderer.render(shot, moving({}, {0, 0, 20})).values, still);
    }
}

// What is everywhere sounds the same to a fan that transmits wide, however it turns.
TEST(PingMotion, TheWaterKeepsItsLevelWhereItIsLit) {
    Water water = test::water_of(c);
    water.scattering = {{0, -50}};
    RendererOptions options = patterned();
    options.effects.set(Effect::reverberation);
    options.surface.reset();
    Renderer renderer(test::scene_of({test::wall_at(-500, 1, -1, 1)}), water, options);
    const Shot shot = imaging(50);
    const Echogram still = renderer.render(shot, {}), turned = renderer.render(shot, yawing);
    for (std::size_t beam = 8; beam < 32; beam += 4)
        for (const std::size_t bin : {50U, 150U, 350U})
            EXPECT_NEAR(db(turned.beam(beam)[bin] / still.beam(beam)[bin]), 0, 0.1) << beam << ' ' << bin;
}

// What a head sent into it, it hears by the pattern of where it looks by then.
TEST(PingMotion, AHeadLosesOfTheWaterAsOfAWall) {
    Water water = test::water_of(c);
    water.scattering = {{0, -50}};
    RendererOptions options = patterned();
    options.effects.set(Effect::reverberation);
    options.surface.reset();
    Renderer renderer(test::scene_of({test::wall_at(-500, 1, -1, 1)}), water, options);
    const auto lost = [&](const Shot& shot, const Situation& situation, double range) {
        const auto bin = static_cast<std::size_t>(range / 55 * 200);
        const double still = double{renderer.render(shot, {}).beam(0)[bin]};
        return db(double{renderer.render(shot, situation).beam(0)[bin]} / still);
    };
    constexpr double width = 3 * 1.001906 / 1.391557;
    for (const double range : {12.5, 25.0, 50.0})
        EXPECT_NEAR(lost(head(55), yawing, range), loss_of_line(width, range / 25), 0.1) << range;
    Shot upright = head(55);
    upright.fan_height = deg_to_rad(width);
    EXPECT_NEAR(lost(upright, moving({}, {0, 30, 0}), 50), -3.02, 0.2);
    Shot aside = head(55);  // its own axis is that of the roll
    aside.bearings = {deg_to_rad(60)};
    EXPECT_NEAR(lost(aside, yawing, 50), -3.02, 0.2);
    upright.horizontal.shape = upright.vertical.shape = ApertureShape::piston;
    EXPECT_NEAR(lost(upright, moving({}, {0, 30, 0}), 50), lost(upright, yawing, 50), 0.01);
}

TEST(PingMotion, RowsOfBeamsTurnBothWays) {
    Shot shot = test::fan(40, 2, 40, 400, 45);
    for (int row = -10; row <= 10; ++row) shot.elevations.push_back(deg_to_rad(row));
    shot.beam_width = shot.fan_height = deg_to_rad(1.5);
    shot.horizontal = shot.vertical = {ApertureShape::hamming, 1};
    for (const auto& scene : {test::scene_of({plate(40, 1)}), target(40)}) {
        Renderer renderer(scene, test::water_of(c), patterned());
        const auto middle = [&](const Situation& situation) {
            double sum = 0, x = 0, y = 0;
            for (shot.ping = 0; shot.ping < 32; ++shot.ping) {
                const Echogram e = renderer.render(shot, situation);
                for (std::size_t beam = 0; beam < e.beams(); ++beam) {
                    const double power = test::beam_power(e, beam);
                    sum += power, x += power * rad_to_deg(shot.bearings[beam % 40]);
                    y += power * rad_to_deg(shot.elevations[beam / 40]);
                }
            }
            return std::pair(x / sum, y / sum);
        };
        const auto [x0, y0] = middle({});
        const auto [x1, y1] = middle(moving({}, {0, 20, 30}));
        EXPECT_NEAR(x1 - x0, 1.6, 0.1);
        EXPECT_NEAR(y1 - y0, 20 * 40 * 2 / c, 0.1);
        const auto [x2, y2] = middle(moving({}, {0, 20, -30}));
        EXPECT_NEAR(x2 - x0, -1.6, 0.1);
    }
}

}  // namespace
}  // namespace echoloop
