#include <gtest/gtest.h>

#include <numbers>

#include "render/acoustics/random.h"
#include "tests/render/acoustics/chain_shots.h"
#include "tests/render/acoustics/statistics.h"

namespace echoloop {
namespace {

using test::chain_shot;
using test::only;
using test::output;

const Effects speckled = only({Effect::pulse, Effect::speckle});
constexpr double wavelength = 0.002;  ///< m, 750 kHz

/// Every `step`th bin of every beam.
std::vector<float> thinned(const std::vector<float>& values, const Shot& shot, std::size_t step) {
    std::vector<float> out;
    for (std::size_t beam = 0; beam < shot.bearings.size(); ++beam)
        for (std::size_t bin = 60; bin < shot.bins; bin += step)
            out.push_back(values[beam * shot.bins + bin]);
    return out;
}

void expect_fully_developed(const IntensityStatistics& s) {
    EXPECT_NEAR(s.amplitude_cv, 0.5227, 0.01);
    EXPECT_NEAR(s.scintillation, 1, 0.04);
    EXPECT_NEAR(s.skewness, 2, 0.15);
    EXPECT_NEAR(s.db_deviation, 5.57, 0.1);
    EXPECT_NEAR(s.db_offset, -2.51, 0.05);
    EXPECT_LT(s.kolmogorov, s.kolmogorov_limit);
}

// V8, in bins of a quarter of the pulse (every 8th is independent), of the pulse, and far shorter than it.
TEST(Speckle, FullyDeveloped) {
    for (const double bin : {0.075, 0.01875, 0.0009}) {
        const Shot shot = chain_shot(120, 4000, bin, 0.075);
        const auto apart = static_cast<std::size_t>(std::ceil(0.15 / bin));
        std::vector<float> values;
        for (int place = 0; values.size() < 20'000; ++place) {
            const auto more = thinned(output(speckled, shot, 1, {{0.1 * place, 0, 0}, {}}), shot, apart);
            values.insert(values.end(), more.begin(), more.end());
        }
        const IntensityStatistics s = intensity_statistics(values);
        SCOPED_TRACE("bins of " + std::to_string(bin) + " m");
        EXPECT_NEAR(s.mean, 0.075 / bin, 0.03 * 0.075 / bin);
        expect_fully_developed(s);
    }
}

TEST(Speckle, WithoutAPulseEveryBinIsOneLook) {
    const Shot shot = chain_shot(60, 2000, 0.3, 0.075);
    expect_fully_developed(intensity_statistics(output(only({Effect::speckle}), shot)));
}

TEST(Speckle, LongBinsAverageLooks) {
    for (const double looks : {1.5, 2.0, 4.0, 20.0}) {
        const Shot shot = chain_shot(60, 2000, 0.075 * looks, 0.075);
        const IntensityStatistics s = intensity_statistics(output(speckled, shot));
        EXPECT_NEAR(s.mean * looks, 1, 0.01);
        EXPECT_NEAR(s.scintillation * looks, 1, 0.03) << looks << " looks";
    }
}

// Correlation length in range = pulse length: that of intensity falls below 1/2 within half to a whole pulse,
// and to nothing beyond it.
TEST(Speckle, CorrelatesOverThePulse) {
    const Shot shot = chain_shot(200, 2000, 0.01, 0.1);
    const auto values = output(speckled, shot);
    const auto correlation_at = [&](std::size_t lag) {
        std::vector<float> a, b;
        for (std::size_t beam = 0; beam < 200; ++beam)
            for (std::size_t bin = 60; bin + lag < 2000; ++bin) {
                a.push_back(values[beam * 2000 + bin]);
                b.push_back(values[beam * 2000 + bin + lag]);
            }
        return correlation(a, b);
    };
    EXPECT_GT(correlation_at(1), 0.7);
    EXPECT_GT(correlation_at(3), 0.4);
    EXPECT_LT(correlation_at(7), 0.35);
    EXPECT_LT(std::abs(correlation_at(16)), 0.02);
}

TEST(Speckle, SameViewSameBytes) {
    Shot shot = chain_shot(20, 500, 0.02, 0.075);
    const Pose pose{{1, 2, -3}, from_rpy(0.1, 0.2, 0.3)};
    const auto first = output(speckled, shot, 1, pose);
    shot.ping = 99;
    EXPECT_EQ(output(speckled, shot, 1, pose), first);
    shot.random_key = 8;
    EXPECT_LT(std::abs(correlation(output(speckled, shot, 1, pose), first)), 0.05);
}

TEST(Speckle, AQuarterWavelengthDecorrelates) {
    const Shot shot = chain_shot(20, 2000, 0.1, 0.075);
    const auto at = [&](Vec3 position) { return output(speckled, shot, 1, {position, {}}); };
    const double step = wavelength / 4;
    for (int i = 0; i < 8; ++i) {  // wherever it was before
        const Vec3 start{i * wavelength / 16, 3 - i * wavelength / 16, -5 + i * wavelength / 16};
        const auto before = at(start);
        for (const Vec3 moved : {Vec3{step, 0, 0}, Vec3{0, -step, 0}, Vec3{0, 0, step}})
            EXPECT_LT(std::abs(correlation(at(start + moved), before)), 0.025) << i;
    }
    EXPECT_EQ(at({1 + wavelength / 100, 2, -3}), at({1, 2, -3}));
}

// Beams against each other, bins against each other, port against starboard.
TEST(Speckle, CellsAreIndependent) {
    for (const double bin : {0.02, 0.15}) {
        const Shot shot = chain_shot(64, 4000, bin, 0.075);
        const auto values = output(speckled, shot);
        const auto beam = [&](std::size_t i) {
            return thinned({&values[i * 4000], &values[i * 4000] + 4000}, chain_shot(1, 4000, bin, 0.075),
                           bin < 0.1 ? 8 : 1);
        };
        const double limit = bin < 0.1 ? 0.16 : 0.06;  // 3.6 standard errors of one pair
        double pairs = 0, mirrored = 0;
        for (std::size_t i = 0; i < 32; ++i) {
            EXPECT_LT(std::abs(correlation(beam(i), beam(i + 1))), limit) << "beams " << i << " and the next";
            EXPECT_LT(std::abs(correlation(beam(i), beam(63 - i))), limit) << "port and starboard of " << i;
            pairs += correlation(beam(i), beam(i + 1)) / 32,
                mirrored += correlation(beam(i), beam(63 - i)) / 32;
        }
        EXPECT_NEAR(pairs, 0, 0.05);
        EXPECT_NEAR(mirrored, 0, 0.05);
    }
}

// A head that steps by less than its beam: neighbours look alike, directions a width apart do not.
TEST(Speckle, OfAScanningHeadFollowsTheBearing) {
    for (const double bin : {0.02, 0.1}) {
        Shot shot = chain_shot(1, 4000, bin, 0.075);
        const auto at = [&](double pan_deg, double yaw_deg) {
            shot.pan = deg_to_rad(pan_deg);
            return output(speckled, shot, 1, {{}, from_rpy(0, 0, deg_to_rad(yaw_deg))});
        };
        const auto centre = at(40, 0);
        EXPECT_GT(correlation(at(40.1, 0), centre), 0.6) << bin;
        EXPECT_LT(std::abs(correlation(at(41.01, 0), centre)), 0.15) << bin;
        EXPECT_GT(correlation(at(40, -0.1), centre), 0.6) << "yaw to starboard adds to the bearing";
        EXPECT_GT(correlation(at(30, -10), centre), 0.99);
        for (const double pan : {40.0, 40.1, 40.25, 40.37}) {
            const auto values = at(pan, 0);
            EXPECT_NEAR(test::sum_of(values) / 4000 * bin / 0.075, 1, 0.12) << pan;
        }
    }
}

TEST(Speckle, OfAHangingHeadFollowsTheBearing) {
    Shot shot = chain_shot(1, 2000, 0.1, 0.075);
    const auto at = [&](double pan_deg, double yaw_deg) {
        shot.pan = deg_to_rad(pan_deg);
        return output(speckled, shot, 1, {{}, from_rpy(std::numbers::pi, 0, deg_to_rad(yaw_deg))});
    };
    EXPECT_GT(correlation(at(30, 10), at(40, 0)), 0.99);
    EXPECT_LT(std::abs(correlation(at(30, -10), at(40, 0))), 0.1);
}

TEST(Speckle, CloseBeamsArePartlyCorrelated) {
    Shot shot = chain_shot(64, 2000, 0.02, 0.075);
    for (double& bearing : shot.bearings) bearing *= 0.25;  // a quarter of a width apart
    const auto values = output(speckled, shot);
    double next = 0, width = 0, most = 0;
    for (std::size_t i = 0; i < 60; ++i) {
        const auto beam = [&](std::size_t b) { return std::span(values).subspan(b * 2000, 2000); };
        next += correlation(beam(i), beam(i + 1)) / 60, width += correlation(beam(i), beam(i + 4)) / 60;
        most = std::max(most, correlation(beam(i), beam(i + 1)));
    }
    EXPECT_LT(most, 0.95) << "no two beams are the same";
    EXPECT_GT(next, 0.4);
    EXPECT_NEAR(width, 0, 0.05);
}

TEST(Speckle, KDistribution) {
    for (const double shape : {0.5, 2.0, 10.0}) {
        const Shot shot = chain_shot(200, 4000, 0.075, 0.075);
        const auto s = intensity_statistics(output(speckled, shot, 1, {}, {shape}));
        EXPECT_NEAR(s.mean, 1, 0.02);
        EXPECT_NEAR(s.scintillation, 1 + 2 / shape, 0.06 * (1 + 2 / shape)) << "nu " << shape;
    }
}

// Rician: the point's power adds to the mean, and its interference to the variance.
TEST(Speckle, APointInterferesWithTheBottom) {
    for (const double bin : {0.02, 0.3}) {
        Shot shot = chain_shot(1, 40, bin, 0.075);
        const double looks = std::max(1.0, bin / 0.075), height = 0.075 / bin;
        AcousticChain chain(speckled);
        std::vector<float> seen;
        for (int i = 0; i < 20'000; ++i) {
            std::vector<float> values(40, 1.0F);
            const PointEcho point{0, 20.2 * bin, 9 * (looks > 1 ? 1 : height), 1.2};
            chain.apply(shot, {{0.01 * i, 0, 0}, {}}, test::water_speed, {&point, 1}, values);
            seen.push_back(values[looks > 1 ? 20 : 22]);
        }
        const double diffuse = height, echo = 9 * height;
        const auto s = intensity_statistics(seen);
        EXPECT_NEAR(s.mean, diffuse + echo, 0.06 * (diffuse + echo)) << bin;
        const double variance = (diffuse * diffuse + 2 * diffuse * echo) / looks;
        EXPECT_NEAR(s.scintillation * s.mean * s.mean, variance, 0.12 * variance) << bin;
    }
}

TEST(Random, ThreefryKnownAnswers) {  // Random123's kat_vectors, threefry4x32, 13 rounds
    EXPECT_EQ(threefry({0, 0, 0, 0}, {0, 0, 0, 0}),
              (std::array<std::uint32_t, 4>{0x531c7e4f, 0x39491ee5, 0x2c855a92, 0x3d6abf9a}));
    EXPECT_EQ(threefry({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344},
                       {0xa4093822, 0x299f31d0, 0x082efa98, 0xec4e6c89}),
              (std::array<std::uint32_t, 4>{0x4aa71d8f, 0x734738c2, 0x431fc6a8, 0xae6debf1}));
}

TEST(Random, ComplexNormals) {
    constexpr std::size_t count = 1 << 20;
    std::vector<float> real(count), imaginary(count);
    complex_normals({1, 2, 3, 4}, count, real.data(), imaginary.data());
    double mean = 0, square = 0, fourth = 0, cross = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const double x = static_cast<double>(real[i]), y = static_cast<double>(imaginary[i]);
        mean += x / count, square += (x * x + y * y) / count, fourth += x * x * x * x / count,
            cross += x * y / count;
    }
    EXPECT_NEAR(mean, 0, 0.003);
    EXPECT_NEAR(square, 1, 0.004);
    EXPECT_NEAR(fourth, 0.75, 0.01);  // three times the square of the variance 1/2
    EXPECT_NEAR(cross, 0, 0.002);
}

}  // namespace
}  // namespace echoloop
