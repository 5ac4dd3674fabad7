// A SeaKing as hosts of heads before the DST see it: two frequencies, slope, its own user block.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/emulator/devices/micron_bench.h"

namespace echoloop::test {
namespace {

// HdCtrl 0x2307, HdType 2, TxN 675 kHz twice, RxN + 455 kHz, 10 m, step 16, 300 bins of 104 units, slope 125,
// gain 40 %
const std::string high =
    "40303033433c00ff0237138002010723026666660566666605713d0a09713d0a09640064000000000051085454"
    "7d007d0019106800"
    "2c01e80364004006010000000a";
// The same with 325 kHz on channel 1 and 675 kHz on channel 2, slopes 90 and 125, gains 40 and 50 %
const std::string two_channels =
    changed(changed(changed(changed(high, 17, "99999902"), 25, "a3703d06"), 45, "5a007d00"), 43, "5469");

Bench seaking(const std::string& command, const Options& changes = {}) {
    return scanning(command, changes, "tritech-seaking");
}

Shot shot_of(const std::string& command) {
    Bench bench = seaking(command);
    bench.say(send_data);
    return bench.ping ? bench.ping->shot : Shot{};
}

Bytes line_of(Bench& bench) {
    bench.say(send_data);
    bench.hear();
    return lines(bench.sent()).at(0);
}

TEST(SeaKing, TxNChoosesTheFrequencyAndItsBeam) {
    const Shot at_675 = shot_of(high), at_325 = shot_of(two_channels);
    EXPECT_NEAR(at_675.frequency, 675e3, 50);
    EXPECT_NEAR(at_325.frequency, 325e3, 50);
    EXPECT_NEAR(at_675.beam_width, deg_to_rad(1.5), 1e-3);
    EXPECT_NEAR(at_325.beam_width, deg_to_rad(3), 1e-3);
    EXPECT_EQ(at_675.bandwidth, 0) << "a tone";
    const Shot at_580 = shot_of(changed(changed(high, 17, "0ad7a304"), 25, "00000000"));
    EXPECT_NEAR(at_580.frequency, 580e3, 50);
    EXPECT_NEAR(at_580.beam_width, deg_to_rad(1.5 * 675 / 580), 1e-3) << "the same transducer";
}

TEST(SeaKing, WithoutTxNTheUsualFrequencyIsSent) {
    const Shot shot = shot_of(changed(changed(high, 17, "00000000"), 25, "00000000"));
    EXPECT_NEAR(shot.frequency, 675e3, 1);
    EXPECT_GT(shot.source_level, 200);
}

TEST(SeaKing, AReceiverTunedElsewhereHearsNothing) {
    EXPECT_LT(shot_of(changed(high, 25, "a3703d06")).source_level, 0) << "sends 675, listens at 325 kHz";
    EXPECT_GT(shot_of(changed(high, 25, "00000000")).source_level, 200) << "no RxN: tuned as it sends";
}

TEST(SeaKing, AbsurdFrequenciesAreTakenAsTheNearestOne) {
    EXPECT_LE(shot_of(changed(changed(high, 17, "ffffffff"), 25, "00000000")).frequency, 1.3e6);
    EXPECT_GE(shot_of(changed(changed(high, 17, "01000000"), 25, "00000000")).frequency, 199e3);
}

TEST(SeaKing, Chan2UsesTheSecondChannel) {
    Bench bench = seaking(changed(two_channels, 14, "8723"));
    const Bytes line = line_of(bench);
    EXPECT_NEAR(bench.shots[0].frequency, 675e3, 50);
    EXPECT_EQ(line[26], 0x69) << "gain of channel 2";
    EXPECT_EQ(u16(line, 27), 125) << "slope";
    EXPECT_EQ(to_hex(ByteView(line).subspan(22, 4)), "66666605") << "TxN";
}

TEST(SeaKing, PingPongAlternatesBetweenTheChannels) {
    const std::string alternating = changed(two_channels, 15, "2b");
    Bench bench = seaking(alternating);
    bench.say(send_data);
    bench.say(send_data);
    bench.run_to(bench.now + 2s);
    ASSERT_EQ(bench.shots.size(), 4u);
    for (std::size_t i : {0u, 2u}) EXPECT_NEAR(bench.shots[i].frequency, 325e3, 50) << i;
    for (std::size_t i : {1u, 3u}) EXPECT_NEAR(bench.shots[i].frequency, 675e3, 50) << i;
    const auto found = lines(bench.sent());
    EXPECT_EQ(found[0][26], 0x54);
    EXPECT_EQ(found[1][26], 0x69);
    Bench ignoring = seaking(alternating, {{"ping_pong", std::string("ignore")}});
    ignoring.say(send_data);
    ignoring.run_to(ignoring.now + 1s);
    EXPECT_NEAR(ignoring.shots.at(1).frequency, 325e3, 50);
}

TEST(SeaKing, SlopeIsTheStrengthOfTheTimeVariedGain) {
    const auto level = [](const std::string& slope) {
        Bench bench = seaking(changed(high, 45, slope));
        bench.echo_bin = 200;  // (200.5 * 104 * 640 ns) * 750 = 10.009 m
        bench.echo_power = 1e15F;
        return line_of(bench)[44 + 200] * 80 / 255.0;
    };
    // 150 dB + 80 dB * 84 / 210 - 163 dB = 19 dB; at the usual slope also 30 log 10.009 + 2 * 0.19 * 10.009
    // Words are whole half decibels, rounded down, so a level lies up to 0.5 dB below.
    EXPECT_NEAR(level("0000") + 0.25, 19, 0.3);
    EXPECT_NEAR(level("7d00") + 0.25, 19 + 30.01 + 3.80, 0.3);
    EXPECT_NEAR(level("3e00") + 0.25, 19 + (30.01 + 3.80) * 62 / 125, 0.3);
}

TEST(SeaKing, DeviceTypeIsThatOfTheCommandAndBinsAreFewer) {
    Bench bench = seaking(changed(high, 53, "dc05"));  // 1500 bins
    const Bytes line = line_of(bench);
    EXPECT_EQ(line[15], 2);
    EXPECT_EQ(u16(line, 42), 800);
    EXPECT_EQ(line.size(), 845u);
}

TEST(SeaKing, UserBlockSaysHalfDuplexAt99AndNoFpgaMessagesFollow) {
    Bench bench = powered_up({{"half_duplex", true}}, "tritech-seaking");
    bench.say(send_bb_user);
    const auto sent = bench.sent();
    ASSERT_EQ(sent.size(), 1u);
    EXPECT_NE(sent[0].bytes[19], 0x0F);
    EXPECT_EQ(sent[0].bytes[99], 1);
    EXPECT_EQ(sent[0].bytes[146], 0);
    EXPECT_EQ(sent[0].bytes[59], 1) << "has a motor";
}

TEST(SeaKing, GainBlockChangesTheSlopeToo) {
    Bench bench = seaking(high);
    bench.say(gain_block);  // slopes 100
    EXPECT_EQ(u16(line_of(bench), 27), 100);
}

}  // namespace
}  // namespace echoloop::test
