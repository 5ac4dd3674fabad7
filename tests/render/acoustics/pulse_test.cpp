#include "render/acoustics/pulse.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "render/acoustics/bin_filters.h"
#include "tests/render/acoustics/chain_shots.h"

namespace echoloop {
namespace {

using test::chain_shot;
using test::only;
using test::output;
using test::to_db;

const Effects pulse_only = only({Effect::pulse});

Shot chirp(std::size_t bins, double bin, double resolution) {
    Shot shot = chain_shot(1, bins, bin, 10 * resolution);
    shot.bandwidth = test::water_speed / 2 / resolution;
    return shot;
}

TEST(Pulse, ResolutionOfCwAndChirp) {
    Shot shot;
    shot.pulse_length = 25e-6;
    EXPECT_NEAR(range_resolution(shot, 1500), 0.01875, 1e-12);
    shot.pulse_length = 100e-6;
    EXPECT_NEAR(range_resolution(shot, 1500), 0.075, 1e-12);
    shot.bandwidth = 30e3;
    EXPECT_NEAR(range_resolution(shot, 1500), 0.025, 1e-12);
}

/// dB by which the level falls between two equal echoes `apart` m from each other; 0 where there is one peak.
/// A phase of 90 deg between them adds their powers, as the mean over all phases does.
double dip_between(const Shot& shot, double apart, double phase) {
    const double at = 2.0;
    const auto values = output(pulse_only, shot, {{0, at, 1, 0}, {0, at + apart, 1, phase}});
    const double first = *std::max_element(values.begin(), values.end());
    const auto left = std::find_if(values.begin(), values.end(), [&](float v) { return v > 0.9 * first; });
    const auto right = std::find_if(values.rbegin(), values.rend(), [&](float v) { return v > 0.9 * first; });
    return to_db(first / std::max(static_cast<double>(*std::min_element(left, right.base())), 1e-12));
}

TEST(Pulse, TwoPointsAreToldApart) {
    for (const Shot& shot : {chain_shot(1, 8000, 0.0005, 0.01875), chain_shot(1, 1000, 0.004, 0.075),
                             chirp(8000, 0.0005, 0.025)}) {
        const double resolution = range_resolution(shot, test::water_speed);
        EXPECT_GT(dip_between(shot, 1.5 * resolution, std::numbers::pi / 2), 3) << resolution << " m";
        EXPECT_LT(dip_between(shot, 0.5 * resolution, 0), 0.5) << resolution;
    }
}

TEST(Pulse, AreaScatteringDoesNotDependOnTheBins) {
    for (const double bin : {0.0003, 0.001, 0.004, 0.02, 0.075, 0.31, 1.0})
        for (const double length : {0.01, 0.075, 0.5}) {
            const auto bins = static_cast<std::size_t>(4 / bin) + 20;
            for (const Shot& shot : {chain_shot(1, bins, bin, length), chirp(bins, bin, length)}) {
                const auto values = output(pulse_only, shot, static_cast<float>(bin));  // power 1 per metre
                EXPECT_NEAR(to_db(static_cast<double>(values[bins / 2 + 8])), to_db(length), 0.02)
                    << "bins of " << bin << " m, " << length << " m"
                    << (shot.bandwidth > 0 ? " chirp" : " CW");
            }
        }
}

TEST(Pulse, APointKeepsItsEnergyAndItsHeight) {
    for (const double length : {0.01, 0.2, 3.0})
        for (const Shot& shot : {chain_shot(1, 500, 0.05, length), chirp(500, 0.05, length / 3)}) {
            const double at = 12.31, resolution = range_resolution(shot, test::water_speed);
            const auto values = output(pulse_only, shot, {{0, at, 4, 1}});
            EXPECT_NEAR(test::sum_of(values) * 0.05 / (4 * resolution), 1, 0.001);
            if (resolution > 0.15) {
                EXPECT_NEAR(*std::max_element(values.begin(), values.end()), 4, 0.15);
            }
        }
}

// V3: the leading edge of a CW pulse and the middle of a compressed one are at the target's range.
TEST(Pulse, EchoesAreInTheirBin) {
    const double at = 10.02;
    for (const double length : {0.01, 0.4, 5.0}) {
        const auto values = output(pulse_only, chain_shot(1, 500, 0.05, length), {{0, at, 1, 0}});
        const double edge = *std::max_element(values.begin(), values.end()) / 100;
        const auto first = std::find_if(values.begin(), values.end(), [&](float v) { return v >= edge; });
        EXPECT_NEAR(static_cast<double>(first - values.begin()), 200, 1) << length << " m";
    }
    const auto values = output(pulse_only, chirp(500, 0.05, 0.3), {{0, at, 1, 0}});
    EXPECT_NEAR(static_cast<double>(std::max_element(values.begin(), values.end()) - values.begin()), 200, 1);
}

TEST(Pulse, SideLobesOfAChirp) {
    const auto values = output(pulse_only, chirp(4000, 0.001, 0.1), {{0, 2, 1, 0}});
    float highest = 0;
    for (std::size_t i = 2000 + 150; i < 2550; ++i) highest = std::max(highest, values[i]);
    EXPECT_NEAR(to_db(static_cast<double>(highest)), -42.7, 0.7);
    const auto half = std::count_if(values.begin(), values.end(), [](float v) { return v >= 0.5F; });
    EXPECT_NEAR(static_cast<double>(half), 95.6, 1.1);
}

TEST(Pulse, NothingWraps) {
    for (const double length : {0.3, 5.0, 40.0}) {
        const Shot shot = chain_shot(1, 200, 0.05, length);
        EXPECT_EQ(output(pulse_only, shot, {{0, 9.99, 1, 0}})[0], 0);
        EXPECT_EQ(test::sum_of(output(pulse_only, shot, {{0, 10.5, 1, 0}})), 0) << "beyond the window";
        AcousticChain chain(pulse_only);
        std::vector<float> values(200, 0.0F);
        values[199] = 1;
        chain.apply(shot, {}, test::water_speed, {}, values);
        EXPECT_EQ(values[0], 0);
        EXPECT_GT(values[199], 0);
    }
}

// A loud echo leaves nothing behind once its pulse is over, however long: no sums that cancel.
TEST(Pulse, SilenceAfterALoudEchoIsSilent) {
    AcousticChain chain(pulse_only);
    const Shot shot = chain_shot(1, 2000, 0.01, 5);
    std::vector<float> values(2000, 1e-3F);
    values[100] = 1e20F;
    chain.apply(shot, {}, test::water_speed, {}, values);
    EXPECT_NEAR(values[1500], 0.5, 0.001);  // 500 bins of 1e-3
    EXPECT_NEAR(values[400] / 1e20, 1, 1e-3);
}

// The running sums of long pulses against the plain sum.
TEST(Pulse, LongPulsesAreTheSameConvolution) {
    const Shot shot = chain_shot(1, 1000, 0.01, 2.005);
    std::vector<float> power(1000);
    for (std::size_t i = 0; i < power.size(); ++i) power[i] = 1 + static_cast<float>((i * 37) % 11);
    std::vector<double> expected(power.size());
    const PulseShape shape(shot, test::water_speed);
    for (std::size_t j = 0; j < power.size(); ++j)
        for (std::size_t i = 0; i < power.size(); ++i) {
            const double from =
                (static_cast<double>(j) - static_cast<double>(i) - 0.5) * 0.01;  // echo in mid-bin
            expected[j] += static_cast<double>(power[i]) *
                           (shape.energy_until(from + 0.01) - shape.energy_until(from)) / 0.01;
        }
    AcousticChain(pulse_only).apply(shot, {}, test::water_speed, {}, power);
    for (std::size_t j = 0; j < power.size(); ++j)
        ASSERT_NEAR(static_cast<double>(power[j]), expected[j], 0.005 * expected[j] + 3) << "bin " << j;
}

}  // namespace
}  // namespace echoloop
