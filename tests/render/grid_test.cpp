// Rows of beams in one ping (Shot::elevations): where echoes stand, and that each beam hears what a fan's
// beam on the same axis does.
#include <gtest/gtest.h>

#include "tests/render/meshes.h"
#include "tests/render/shots.h"

namespace echoloop {
namespace {

using test::db;
using test::scene_of;

constexpr std::size_t columns = 64, rows = 21;
constexpr double bin = 0.02;  // m

std::vector<double> ladder(std::size_t count, double span_deg) {
    std::vector<double> out;
    for (std::size_t i = 0; i < count; ++i)
        out.push_back(deg_to_rad(span_deg) * (static_cast<double>(i) / static_cast<double>(count - 1) - 0.5));
    return out;
}

/// 70 x 30 deg, steps of 1.1 and 1.5 deg, to 12 m.
Shot grid() {
    Shot shot = test::fan(70, 2, columns, 600, 12);
    shot.bearings = ladder(columns, 70);
    shot.elevations = ladder(rows, 30);
    shot.beam_width = deg_to_rad(1.8), shot.fan_height = deg_to_rad(2.2);
    shot.horizontal = shot.vertical = {ApertureShape::hamming, 1};
    return shot;
}

std::size_t beam_at(std::size_t row, std::size_t column) { return row * columns + column; }

Vec3 axis(const Shot& shot, std::size_t beam) {
    const double b = shot.bearings[beam % columns], e = shot.elevations[beam / columns];
    return {std::cos(e) * std::cos(b), -std::cos(e) * std::sin(b), std::sin(e)};
}

/// The middle beam of a fan that looks along a beam of the grid.
Shot fan_on(const Shot& shot, std::size_t beam) {
    const Vec3 d = axis(shot, beam);
    Shot fan = shot;
    fan.elevations.clear();
    fan.tilt = std::atan2(d.z, d.x);
    const double across = std::asin(-d.y), step = deg_to_rad(1.1);
    fan.bearings.clear();
    for (double off = -step * 31; off < step * 32; off += step)
        if (std::abs(across + off) < deg_to_rad(60)) fan.bearings.push_back(across + off);
    return fan;
}

std::size_t nearest(const std::vector<double>& bearings, double bearing) {
    const auto off = [bearing](double a, double b) { return std::abs(a - bearing) < std::abs(b - bearing); };
    return static_cast<std::size_t>(std::ranges::min_element(bearings, off) - bearings.begin());
}

RendererOptions with(std::initializer_list<Effect> effects) {
    RendererOptions options = test::boxes();
    for (const Effect effect : effects) options.effects.set(effect);
    return options;
}

/// Mean over pings, which see the pixels' whole areas.
std::vector<double> mean_values(Renderer& renderer, Shot shot, std::size_t pings) {
    std::vector<double> mean;
    for (shot.ping = 0; shot.ping < pings; ++shot.ping) {
        shot.random_key = shot.ping;  // moves the samples that side lobes hear
        const Echogram e = renderer.render(shot, {});
        mean.resize(e.values.size());
        for (std::size_t i = 0; i < mean.size(); ++i) mean[i] += e.values[i] / static_cast<double>(pings);
    }
    return mean;
}

std::vector<Mesh> room() {
    return {test::floor_at(-2, 40), test::wall_at(7, 40, -2, 6),
            test::box("box", {4, 1.2, -1.2}, {1, 1.4, 1.6}, 0.4, -20),
            test::sphere({5, -1.5, 0.4}, 0.6, 12, -15)};
}

TEST(Grid, AWallIsAtItsRangeInEveryBeam) {
    Renderer renderer(scene_of({test::wall_at(6, 50, -50, 50)}), test::water_of(1500), test::boxes());
    const Shot shot = grid();
    const Echogram e = renderer.render(shot, {});
    ASSERT_EQ(e.beams(), columns * rows);
    ASSERT_EQ(e.values.size(), e.beams() * shot.bins);
    for (std::size_t beam = 0; beam < e.beams(); ++beam) {
        const Vec3 d = axis(shot, beam);
        const double range = 6 / d.x, spread = range * deg_to_rad(1.2) * std::sqrt(1 - d.x * d.x) / d.x;
        EXPECT_NEAR(e.truth[beam].axis_range, range, 2e-3) << beam;
        EXPECT_NEAR(e.truth[beam].nearest_range, range - spread, 0.7 * spread + 0.02) << beam;
        const auto peak = static_cast<double>(test::strongest_bin(e.beam(beam)));
        EXPECT_NEAR((peak + 0.5) * bin, range, spread + bin) << beam;
    }
}

TEST(Grid, WhatIsBehindAPlateIsInItsShadow) {
    const Mesh wall = test::wall_at(8, 50, -50, 50), plate = test::wall_at(4, 0.7, -0.5, 0.5);
    Renderer renderer(scene_of({wall, plate}), test::water_of(1500), test::boxes());
    const Shot shot = grid();
    const Echogram e = renderer.render(shot, {});
    std::size_t hidden = 0, open = 0;
    for (std::size_t beam = 0; beam < e.beams(); ++beam) {
        const Vec3 d = axis(shot, beam);
        const double y = std::abs(d.y / d.x) * 4, z = std::abs(d.z / d.x) * 4, margin = 4 * deg_to_rad(2.2);
        double near = 0, far = 0;
        for (std::size_t i = 0; i < shot.bins; ++i) (i < 300 ? near : far) += e.beam(beam)[i];
        if (y < 0.7 - margin && z < 0.5 - margin) {
            EXPECT_GT(near, 0) << beam;
            EXPECT_EQ(far, 0) << beam;
            ++hidden;
        } else if (y > 0.7 + margin || z > 0.5 + margin) {
            EXPECT_EQ(near, 0) << beam;
            EXPECT_GT(far, 0) << beam;
            ++open;
        }
    }
    EXPECT_GT(hidden, 50U);
    EXPECT_GT(open, 1000U);
}

struct Difference {
    double worst = 0, mean = 0;
    void add(double difference, double parts) {
        worst = std::max(worst, std::abs(difference));
        mean += difference / parts;
    }
};

/// From beams of fans, which are drawn more finely along a beam's height and less finely beside it: of whole
/// echoes' power in dB, and of their mean range in m.
std::pair<Difference, Difference> from_fans(const RendererOptions& options) {
    Renderer renderer(scene_of(room()), test::water_of(1500), options);
    const Shot shot = grid();
    const auto all = mean_values(renderer, shot, 16);
    std::pair<Difference, Difference> off;
    for (std::size_t row = 1; row < rows; row += 3)
        for (std::size_t column = 2; column < columns; column += 7) {
            const std::size_t beam = beam_at(row, column);
            const Shot fan = fan_on(shot, beam);
            const auto fans = mean_values(renderer, fan, 16);
            const std::size_t own = nearest(fan.bearings, std::asin(-axis(shot, beam).y));
            double power = 0, expected = 0, moment = 0, expected_moment = 0;
            for (std::size_t i = 0; i < shot.bins; ++i) {
                const double at = static_cast<double>(i) * bin, a = all[beam * shot.bins + i];
                const double b = fans[own * shot.bins + i];
                power += a, moment += a * at, expected += b, expected_moment += b * at;
            }
            off.first.add(db(power / expected), 7 * 9);
            off.second.add(moment / power - expected_moment / expected, 7 * 9);
        }
    return off;
}

TEST(Grid, BeamsHearWhatBeamsOfFansDo) {
    for (const auto& options :
         {with({Effect::beam_pattern}), with({Effect::beam_pattern, Effect::side_lobes})}) {
        const auto [power, range] = from_fans(options);
        EXPECT_LT(power.worst, 1.2) << "dB, where an edge is in the beam";
        EXPECT_NEAR(power.mean, 0, 0.15);
        EXPECT_LT(range.worst, 0.35);
        EXPECT_NEAR(range.mean, 0, 0.02);
    }
}

/// A bright plate in the middle of nothing: who hears it through side lobes, and how loud.
TEST(Grid, SideLobesHearABrightPlateAlongRowAndColumnOnly) {
    const Shot shot = grid();
    const std::size_t row = 10, column = 20, own = beam_at(row, column);
    const Vec3 d = axis(shot, own);
    Mesh plate = test::quad("plate", {0, 0.1, -0.1}, {0, -0.1, -0.1}, {0, -0.1, 0.1}, {0, 0.1, 0.1}, 20);
    const Quat turn = axis_angle({0, 0, 1}, -shot.bearings[column]);
    for (Vec3& p : plate.positions) p = rotate(turn, p) + 5 * d;
    for (Vec3& n : plate.normals) n = rotate(turn, n);
    Renderer renderer(scene_of({plate}), test::water_of(1500),
                      with({Effect::beam_pattern, Effect::side_lobes}));
    const auto all = mean_values(renderer, shot, 16);
    const auto power = [&](std::size_t beam) {
        double sum = 0;
        for (std::size_t i = 0; i < shot.bins; ++i) sum += all[beam * shot.bins + i];
        return sum;
    };
    for (const std::size_t other : {beam_at(row, 2), beam_at(row, 30), beam_at(row, 60)}) {
        const double down = db(power(other) / power(own));
        EXPECT_LT(down, -38) << "Hamming shading: side lobes of -42 dB";
        EXPECT_GT(down, -62);
        const Shot fan = fan_on(shot, own);  // the same plane
        const auto fans = mean_values(renderer, fan, 16);
        const std::size_t same = nearest(fan.bearings, shot.bearings[other % columns]);
        const std::size_t middle = nearest(fan.bearings, shot.bearings[column]);
        double far = 0, centre = 0;
        for (std::size_t i = 0; i < shot.bins; ++i)
            far += fans[same * shot.bins + i], centre += fans[middle * shot.bins + i];
        EXPECT_NEAR(down, db(far / centre), 6) << "lobes are means over a few degrees";
    }
    for (const std::size_t other : {beam_at(1, column), beam_at(19, column)}) {
        EXPECT_LT(db(power(other) / power(own)), -38);
        EXPECT_GT(db(power(other) / power(own)), -70);
    }
    EXPECT_EQ(power(beam_at(1, 60)), 0) << "weaker by both";
}

TEST(Grid, AnEchoFromBelowTheFieldIsHeardThroughSideLobes) {
    RendererOptions options = with({Effect::beam_pattern, Effect::side_lobes});
    options.jitter = false;  // a pixel that is sampled in its middle shows the bottom straight down
    Renderer renderer(scene_of({test::floor_at(-3, 100)}), test::water_of(1500), options);
    const auto mean = mean_values(renderer, grid(), 1);
    // Looks up to the open water: nothing but the bottom below, the nearest of it straight down.
    const auto up = std::span(mean).subspan(beam_at(rows - 1, columns / 2) * grid().bins, grid().bins);
    const auto first = std::ranges::find_if(up, [](double power) { return power > 0; });
    EXPECT_NEAR((static_cast<double>(first - up.begin()) + 0.5) * bin, 3, 0.03);
    EXPECT_NEAR((static_cast<double>(std::ranges::max_element(up) - up.begin()) + 0.5) * bin, 3, 0.3);
    Renderer deaf(scene_of({test::floor_at(-3, 100)}), test::water_of(1500), with({Effect::beam_pattern}));
    const Echogram silent = deaf.render(grid(), {});
    EXPECT_EQ(test::beam_power(silent, beam_at(rows - 1, columns / 2)), 0);
}

/// Nothing else in reach.
std::shared_ptr<const Scene> scene_with(const PointTarget& target) {
    const std::vector<Mesh> meshes{test::floor_at(-500, 1)};
    return Scene::from_meshes(meshes, {&target, 1});
}

TEST(Grid, ATargetIsHeardInItsRowAndColumn) {
    const Shot shot = grid();
    const std::size_t row = 14, column = 45, own = beam_at(row, column);
    RendererOptions options = with({Effect::beam_pattern, Effect::side_lobes});
    const PointTarget target{"target", 5 * axis(shot, own), -10};
    Renderer renderer(scene_with(target), test::water_of(1500), options);
    const Echogram e = renderer.render(shot, {});
    EXPECT_NEAR((static_cast<double>(test::strongest_bin(e.beam(own))) + 0.5) * bin, 5, bin);
    const double level = shot.source_level - 10 - 40 * std::log10(5.0) -
                         2 * 5 * absorption_db_per_km(test::water_of(1500), shot.frequency) / 1000;
    EXPECT_NEAR(db(test::beam_power(e, own)), level, 0.1);
    const auto down = [&](std::size_t r, std::size_t c) {
        return db(test::beam_power(e, beam_at(r, c)) / test::beam_power(e, own));
    };
    // Hamming shading: -3 dB half a width off, where the beams are 1.11 and 1.5 deg apart.
    EXPECT_NEAR(down(row, column + 1), -3 * std::pow(1.11 / 0.9, 2), 0.6);
    EXPECT_NEAR(down(row + 1, column), -3 * std::pow(1.5 / 1.1, 2), 0.8);
    EXPECT_LT(down(row, 5), -38);
    EXPECT_LT(down(2, column), -38);
    EXPECT_EQ(test::beam_power(e, beam_at(2, 5)), 0);
}

// The water's surface mirrors what lies below it: a target is seen once more, above the surface.
TEST(Grid, AnEchoByTheSurfaceArrivesFromAbove) {
    Shot shot = grid();
    RendererOptions options = with({Effect::beam_pattern, Effect::multipath});
    options.surface = WaterSurface{0.5, 0};
    const PointTarget target{"target", {5, 0, 0}, -10};
    Renderer renderer(scene_with(target), test::water_of(1500), options);
    const Echogram e = renderer.render(shot, {});
    const double way = std::hypot(5.0, 1.0), up = rad_to_deg(std::atan2(1.0, 5.0));  // the image is 1 m up
    const auto row = static_cast<std::size_t>(std::lround((up + 15) / 1.5));
    const auto beam = e.beam(beam_at(row, columns / 2));
    // Out and back by the surface, and one way each: half a step in range apart.
    double both = 0, one = 0;
    for (std::size_t i = 0; i < shot.bins; ++i) {
        const double range = (static_cast<double>(i) + 0.5) * bin;
        if (std::abs(range - way) < 1.5 * bin) both += beam[i];
        if (std::abs(range - (way + 5) / 2) < 1.5 * bin) one += beam[i];
    }
    EXPECT_GT(both, 0);
    EXPECT_GT(one, 0);
    EXPECT_NEAR(both + one, test::beam_power(e, beam_at(row, columns / 2)), 0.01 * both);
}

// A smooth wall beside shows the floor's echo once more, from where the mirror is.
TEST(Grid, DiffuseEchoesByAMirrorAreInBeamsThatSeeIt) {
    RendererOptions off = with({Effect::beam_pattern}), on = with({Effect::beam_pattern, Effect::multipath});
    on.surface = WaterSurface{1, 0};
    off.surface = on.surface;
    const std::vector<Mesh> floor{test::floor_at(-2, 60)};
    Renderer without(scene_of(floor), test::water_of(1500), off),
        reflecting(scene_of(floor), test::water_of(1500), on);
    const Shot shot = grid();
    const auto plain = mean_values(without, shot, 8), mirrored = mean_values(reflecting, shot, 8);
    const auto power = [&](const std::vector<double>& values, std::size_t row) {
        double sum = 0;
        for (std::size_t i = 0; i < shot.bins; ++i) sum += values[beam_at(row, columns / 2) * shot.bins + i];
        return sum;
    };
    EXPECT_EQ(power(plain, rows - 2), 0) << "13.5 deg up: open water";
    // The floor is seen in the surface 4 m up at 15 deg: 4 m below the surface's image is 2 m + 2 m.
    EXPECT_EQ(power(mirrored, rows / 2), power(plain, rows / 2)) << "level: neither";
    Shot far = grid();
    far.bin_interval *= 3;  // to 36 m
    const auto seen = mean_values(reflecting, far, 8);
    const double range = 4 / std::sin(deg_to_rad(13.5));
    double sum = 0, moment = 0;
    for (std::size_t i = 0; i < far.bins; ++i) {
        const double value = seen[beam_at(rows - 2, columns / 2) * far.bins + i];
        sum += value, moment += value * (static_cast<double>(i) + 0.5) * 3 * bin;
    }
    EXPECT_GT(sum, 0);
    EXPECT_NEAR(moment / sum, range, 0.15 * range) << "the floor's image in the surface";
}

TEST(Grid, ObjectsAreToldByBinWhereTheyAreAskedFor) {
    const Mesh wall = test::wall_at(8, 50, -50, 50), floor = test::floor_at(-1, 60);
    Renderer renderer(scene_of({wall, floor}), test::water_of(1500), test::boxes());
    const Shot shot = grid();
    EXPECT_TRUE(renderer.render(shot, {}).objects.empty());
    Situation situation;
    situation.objects = true;
    const Echogram e = renderer.render(shot, situation);
    ASSERT_EQ(e.objects.size(), e.values.size());
    const auto name = [&](std::size_t i) { return renderer.scene().objects()[e.objects[i] - 1U]; };
    for (std::size_t column = 0; column < columns; column += 9) {
        const std::size_t low = beam_at(1, column),
                          level = beam_at(rows / 2, column);  // 13.5 deg down: 4.3 m
        const auto at_low = low * shot.bins + test::strongest_bin(e.beam(low));
        const auto at_level = level * shot.bins + test::strongest_bin(e.beam(level));
        EXPECT_EQ(name(at_level), renderer.scene().objects()[0]);
        EXPECT_EQ(name(at_low), renderer.scene().objects()[1]);
        EXPECT_EQ(e.objects[level * shot.bins + 10], 0) << "nothing there";
    }
}

TEST(Grid, TheSameShotGivesTheSameValuesAndRowsHaveNoiseOfTheirOwn) {
    RendererOptions all;
    Shot shot = grid();
    shot.random_key = 7;
    Renderer one(scene_of(room()), test::water_of(1500), all),
        two(scene_of(room()), test::water_of(1500), all);
    const Echogram a = one.render(shot, {}), b = two.render(shot, {});
    EXPECT_EQ(a.values, b.values);
    EXPECT_GT(a.noise_power, 0);
    Renderer nothing(scene_of({test::floor_at(-500, 1)}), test::water_of(1500), all);
    const Echogram noise = nothing.render(shot, {});
    EXPECT_FALSE(std::ranges::equal(noise.beam(beam_at(0, 5)), noise.beam(beam_at(1, 5))));
    EXPECT_NEAR(db(test::total_power(noise) / static_cast<double>(noise.values.size()) / noise.noise_power),
                0, 0.1);
}

TEST(Grid, ThePapersRuleIsAMeanOfCosines) {
    RendererOptions paper = test::boxes();
    paper.rule = EchoRule::cerqueira2016;
    Renderer renderer(scene_of({test::wall_at(6, 50, -50, 50)}), test::water_of(1500), paper);
    const Echogram e = renderer.render(grid(), {});
    const auto middle = e.beam(beam_at(rows / 2, columns / 2));
    EXPECT_NEAR(middle[test::strongest_bin(middle)], 1 / (1 + std::exp(-6)), 0.01) << "cos 1";
}

TEST(Grid, LimitsOfRowsAreChecked) {
    Shot shot = grid();
    EXPECT_NO_THROW(validate(shot));
    std::swap(shot.elevations[3], shot.elevations[4]);
    EXPECT_THROW(validate(shot), std::invalid_argument);
    shot = grid();
    shot.elevations.back() = deg_to_rad(61);
    EXPECT_THROW(validate(shot), std::invalid_argument);
    shot = grid();
    shot.bearings.back() = deg_to_rad(61);
    EXPECT_THROW(validate(shot), std::invalid_argument);
    shot = grid();
    shot.bearings = {0};
    EXPECT_THROW(validate(shot), std::invalid_argument);
    shot = grid();
    shot.bins = 65536;
    EXPECT_THROW(validate(shot), std::invalid_argument) << "more than 16 Mi values";
}

}  // namespace
}  // namespace echoloop
