// Staves that differ: where they put the floor of side lobes, and that it is a unit's own.
#include "render/acoustics/stave_errors.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace echoloop {
namespace {

double db(double power) { return 10 * std::log10(power); }

AperturePattern array_of(std::size_t staves, ApertureShape shape = ApertureShape::hamming) {
    return AperturePattern::of_length(shape, static_cast<double>(staves) / 2);
}

ArrayErrors errors(double amplitude_db, double phase_deg, std::uint64_t unit) {
    return {amplitude_db, deg_to_rad(phase_deg), unit};
}

struct Floor {
    double mean = 0, scintillation = 0,
           highest = 0;  ///< power re main lobe; var / mean^2; mean of units' highest
};

/// Of 200 units, beyond ten beam widths to starboard, without what an ideal array has there.
Floor floor_of(const AperturePattern& ideal, double amplitude_db, double phase_deg) {
    constexpr int units = 200, angles = 1000;
    const double first = 12 / ideal.length_in_wavelengths();
    Floor out;
    double squares = 0;
    for (int unit = 1; unit <= units; ++unit) {
        const StaveErrors array(ideal, 0, errors(amplitude_db, phase_deg, static_cast<std::uint64_t>(unit)),
                                0);
        double highest = 0;
        for (int i = 0; i < angles; ++i) {
            const double angle = std::asin(first + (0.98 - first) * (i + 0.5) / angles);
            const double wrong = array.power(angle), right = std::pow(ideal.amplitude(angle), 2);
            out.mean += (wrong - right) / units / angles;
            squares += wrong * wrong / units / angles;
            highest = std::max(highest, wrong);
        }
        out.highest += highest / units;
    }
    out.scintillation = squares / (out.mean * out.mean) - 1;
    return out;
}

// (sa^2 + sp^2) / N_eff, N_eff = .73 N with Hamming weights.
TEST(StaveErrors, PutTheFloorWhereTheirVarianceSays) {
    for (const auto& [amplitude, phase, of_64, of_256] :
         {std::tuple{0.5, 5.0, -36.3, -42.3}, {0.75, 7.5, -32.8, -38.8}, {1.0, 10.0, -30.3, -36.3}}) {
        EXPECT_NEAR(db(floor_of(array_of(64), amplitude, phase).mean), of_64, 0.5) << amplitude << " dB";
        EXPECT_NEAR(db(floor_of(array_of(256), amplitude, phase).mean), of_256, 0.5) << amplitude << " dB";
    }
}

TEST(StaveErrors, FloorIsExponential) {
    const Floor floor = floor_of(array_of(256), 1, 10);
    EXPECT_NEAR(floor.scintillation, 1, 0.15);
    EXPECT_GT(db(floor.highest / floor.mean), 5.6);
    EXPECT_LT(db(floor.highest / floor.mean), 8);
}

// In sines off the axis; independent errors would leave the floor flat. Closed form of Gaussian correlation
// over 1.1 wavelengths: 4.34 (pi 1.1)^2 (.5^2 - .3^2) dB.
TEST(StaveErrors, ThatNeighboursShareFallWithTheAngle) {
    constexpr int units = 200;
    const auto ideal = array_of(256);
    double near = 0, far = 0;
    for (int unit = 1; unit <= units; ++unit) {
        const StaveErrors array(ideal, 0, errors(0.5, 5, static_cast<std::uint64_t>(unit)));
        for (int i = -5; i <= 5; ++i) {
            const auto wrong = [&](double sine) {
                const double angle = std::asin(sine + 0.002 * i);
                return array.power(angle) - std::pow(ideal.amplitude(angle), 2);
            };
            near += wrong(0.3), far += wrong(0.5);
        }
    }
    EXPECT_NEAR(db(near / far), 4.343 * std::pow(std::numbers::pi * 1.1, 2) * 0.16, 1)
        << "what is of second order falls less";
}

TEST(StaveErrors, CountStavesByTheirWeights) {
    EXPECT_NEAR(StaveErrors(array_of(256), 0, errors(1, 10, 1)).effective_staves() / 256, 0.73, 0.01);
    EXPECT_NEAR(StaveErrors(array_of(256, ApertureShape::line), 0, errors(1, 10, 1)).effective_staves(), 256,
                0.1);
    EXPECT_NEAR(StaveErrors(array_of(256), 64, errors(1, 10, 1)).effective_staves() / 64, 0.73, 0.02);
}

TEST(StaveErrors, AreAUnitsOwnAndLeaveTheAxis) {
    const StaveErrors one(array_of(64), 0, errors(1, 10, 1)), same(array_of(64), 0, errors(1, 10, 1)),
        other(array_of(64), 0, errors(1, 10, 2));
    EXPECT_NEAR(one.power(0), 1, 1e-6);
    double differs = 0;
    for (double angle = -1.5; angle < 1.5; angle += 0.01) {
        EXPECT_EQ(one.power(angle), same.power(angle));
        differs = std::max(differs, std::abs(one.power(angle) - other.power(angle)));
    }
    EXPECT_GT(db(differs), -35);
    EXPECT_NE(one.power(0.7), one.power(-0.7)) << "the two sides of a unit are not alike";
}

TEST(StaveErrors, NoneLeaveTheIdealPattern) {
    const auto ideal = array_of(64);
    const StaveErrors none(ideal, 0, {});
    for (double angle = -3; angle < 3; angle += 0.01)
        EXPECT_NEAR(none.power(angle), std::pow(ideal.amplitude(angle), 2), 1e-6);
}

}  // namespace
}  // namespace echoloop
