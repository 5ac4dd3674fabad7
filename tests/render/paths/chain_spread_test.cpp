// Rough mirrors one after the other through one beam's pattern: energy and lateness against a sum over all
// pairs of directions.
#include "render/paths/chain_spread.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "tests/render/paths/path_rooms.h"

namespace echoloop {
namespace {

/// Bottom, surface, bottom, 8 m apart.
constexpr ChainMirror bottoms[] = {{0.25, 0.35}, {0.5, 0}, {0.75, 0.35}};
constexpr double range = 16;

struct Heard {
    double power = 0, later = 0;  ///< re a chain of smooth mirrors; m, mean
};

Heard mean_of(int pings, double off_axis, std::span<const ChainMirror> mirrors) {
    const Shot first = test::fan(10, 10, 1, 700, 50);
    const FanPattern pattern(first, Effects{});
    const PathSpace space(test::scene_of({test::floor_at(-8, 20)}), {});
    Heard out;
    Shot shot = first;
    for (shot.ping = 0; shot.ping < static_cast<std::uint64_t>(pings); ++shot.ping) {
        const PathPing ping{shot, space, pattern, {}, {}, 0, 0, 50, true, 1, 0.01};
        const FanDirection nadir = pattern.at(fan_direction(off_axis, 0));
        std::vector<PathEcho> echoes;
        if (!add_through_pattern(ping, {mirrors, range, nadir, nadir, 1}, 0, echoes)) return {};
        for (const PathEcho& echo : echoes) {
            const auto power = static_cast<double>(echo.power);
            out.power += power, out.later += power * (static_cast<double>(echo.near_range) - range);
        }
    }
    out.later /= out.power, out.power /= pings;
    return out;
}

/// The same for those mirrors: the surface turns nothing, so the legs tell each other's directions. Sums over
/// a grid of both directions, one axis after the other, of a pattern that is the product of both.
Heard expected(double off_axis) {
    const Shot shot = test::fan(10, 10, 1, 700, 50);
    const FanPattern pattern(shot, Effects{});
    constexpr double step = 0.004, most = 1, turn = 4 * 0.35 * 0.35;
    constexpr double same = turn * (0.75 * 0.75 + 0.25 * 0.25), other = -2 * turn * 0.25 * 0.75;
    constexpr double determinant = same * same - other * other;
    double power[2] = {}, later[2] = {};
    for (int axis = 0; axis < 2; ++axis) {
        const double nadir = axis == 0 ? off_axis : 0;
        const auto amplitude = [&](double angle) {
            return axis == 0 ? pattern.at(fan_direction(angle, 0)).receive
                             : pattern.at(fan_direction(0, angle)).receive;
        };
        for (double out = -most; out < most; out += step)
            for (double in = -most; in < most; in += step) {
                const double a = out - nadir, b = nadir - in, across = (a + b) / 4;
                const double density =
                    std::exp(-(same * (a * a + b * b) - 2 * other * a * b) / (2 * determinant)) /
                    (2 * std::numbers::pi * std::sqrt(determinant));
                const double weight = density * std::pow(amplitude(out) * amplitude(in), 2) * step * step;
                power[axis] += weight;
                later[axis] += weight * range / 2 * (a * a / 4 + b * b / 4 + across * across / 0.5);
            }
    }
    return {power[0] * power[1], later[0] / power[0] + later[1] / power[1]};
}

TEST(ChainSpread, EnergyAndLatenessAreTheIntegralOverThePattern) {
    for (const double off_axis : {0.0, 0.08}) {
        const Heard heard = mean_of(400, off_axis, bottoms), wanted = expected(off_axis);
        EXPECT_NEAR(test::db(heard.power / wanted.power), 0, 0.3) << off_axis;
        EXPECT_NEAR(heard.later / wanted.later, 1, 0.1) << off_axis;
    }
}

TEST(ChainSpread, ASurfaceThatTurnsSoundMakesItLater) {
    auto waves = std::to_array(bottoms);
    waves[1].slope = 0.1;
    // Its facets turn by 0.2 rad, half way between two points 16 m apart: by 0.2^2 4 m / 2 in each of two
    // axes, of which half is range.
    const double later = mean_of(200, 0, waves).later - mean_of(200, 0, bottoms).later;
    EXPECT_GT(later, 0.05);
    EXPECT_LT(later, 0.2);
}

TEST(ChainSpread, OneRoughMirrorOrAFaintPathIsLeftToOthers) {
    const ChainMirror one[] = {{0.25, 0.35}, {0.5, 0}};
    EXPECT_EQ(mean_of(1, 0, one).power, 0);
    EXPECT_EQ(mean_of(1, 1.2, bottoms).power, 0);
}

}  // namespace
}  // namespace echoloop
