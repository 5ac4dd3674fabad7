// The bottom in a single beam, found in echoes made up by the test, and the ring-down against its closed
// form.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "emulator/devices/family/sounder/bottom.h"
#include "tests/emulator/devices/driver.h"

namespace echoloop::test {
namespace {

using echosounder::find_bottom;

/// 1000 bins of 20 us of noise of mean power 1.
Echogram quiet() {
    Shot shot;
    shot.bearings = {0};
    shot.bins = 1000;
    shot.bin_interval = 20e-6;
    Echogram echogram = echo_of(shot, 0, 1);
    echogram.noise_power = 1;
    for (float& v : echogram.values) v = 0.2F;
    return echogram;
}
const echosounder::BottomRule rule{.blanking = 1e-3};

TEST(EchosounderBottom, IsTheLeadingEdgeOfTheFirstStrongEcho) {
    Echogram echogram = quiet();
    for (std::size_t bin = 400; bin < 420; ++bin) echogram.values[bin] = 1e4F;
    for (std::size_t bin = 800; bin < 820; ++bin)
        echogram.values[bin] = 1e3F;  // by way of surface and bottom
    EXPECT_EQ(find_bottom(echogram, rule).value().bin, 400u);
    for (std::size_t bin = 200; bin < 203; ++bin) echogram.values[bin] = 100;  // a few fish
    EXPECT_EQ(find_bottom(echogram, rule).value().bin, 400u);
    echogram.values[399] = 1.3e3F;  // 8.9 dB below the strongest
    EXPECT_EQ(find_bottom(echogram, rule).value().bin, 399u);
}

TEST(EchosounderBottom, IsNotInTheNoise) {
    Echogram echogram = quiet();
    echogram.values[500] = 31;  // 14.9 dB
    EXPECT_FALSE(find_bottom(echogram, rule));
    echogram.values[500] = 32;  // 15.05 dB
    const auto bottom = find_bottom(echogram, rule).value();
    EXPECT_EQ(bottom.bin, 500u);
    EXPECT_NEAR(bottom.above_noise, 15.05, 0.01);
}

TEST(EchosounderBottom, IsNotInTheReverberationEither) {
    Echogram echogram = quiet();
    for (float& v : echogram.values) v = 28.8F;  // a background of mean power 100, 20 dB above the noise
    echogram.values[500] = 3000;
    EXPECT_FALSE(find_bottom(echogram, rule));
    echogram.values[500] = 3200;
    EXPECT_NEAR(find_bottom(echogram, rule).value().above_noise, 15.05, 0.01);
}

TEST(EchosounderBottom, IsNotInTheBlanking) {
    Echogram echogram = quiet();
    echogram.values[49] = 1e9F;
    EXPECT_FALSE(find_bottom(echogram, rule));
    echogram.values[51] = 1e9F;
    EXPECT_EQ(find_bottom(echogram, rule).value().bin, 51u);
}

TEST(EchosounderBottom, WithoutAMarginIsTheLoudestNoise) {
    Echogram echogram = quiet();
    echogram.values[300] = 2;
    auto any = rule;
    any.margin = -std::numeric_limits<double>::infinity();
    any.spreading = 0;
    EXPECT_EQ(find_bottom(echogram, any).value().bin, 300u);
    for (float& v : echogram.values) v = 0;
    EXPECT_FALSE(find_bottom(echogram, any)) << "silence";
}

TEST(EchosounderBottom, GivesBackWhatTheWaterTakes) {
    Echogram echogram = quiet();
    echogram.values[200] = 2e4F;
    echogram.values[800] = 1e3F;  // 13 dB less
    auto flat = rule;
    flat.edge = 0;
    flat.spreading = 0;
    EXPECT_EQ(find_bottom(echogram, flat).value().bin, 200u);
    flat.spreading = 20;  // 12 dB
    EXPECT_EQ(find_bottom(echogram, flat).value().bin, 200u);
    flat.absorption = 100;  // dB/s: 1.2 dB more in 12 ms
    EXPECT_EQ(find_bottom(echogram, flat).value().bin, 800u);
}

TEST(EchosounderBottom, IsFoundInThePapersEchoesToo) {
    Echogram echogram = quiet();
    echogram.rule = EchoRule::cerqueira2016;
    echogram.noise_power = 0;
    for (float& v : echogram.values) v = 0;
    EXPECT_FALSE(find_bottom(echogram, rule));
    echogram.values[600] = 0.8F;
    EXPECT_EQ(find_bottom(echogram, rule).value().bin, 600u);
}

}  // namespace
}  // namespace echoloop::test
