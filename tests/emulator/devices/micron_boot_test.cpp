// The Micron from power-up to its first parameters: literal bytes in and out at given times.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/emulator/devices/micron_bench.h"

namespace echoloop::test {
namespace {

using testing::ElementsAre;

TEST(MicronBoot, FirstAliveComesAfterASecondAndIsExact) {
    Bench bench = powered_up();
    bench.run_to(999ms);
    EXPECT_TRUE(bench.sent().empty());
    bench.run_to(1s);
    const auto sent = bench.sent();
    ASSERT_EQ(sent.size(), 1u);
    EXPECT_EQ(to_hex(sent[0].bytes), "4030303130100002ff0b04800280e8030000800c5d0a");
}

TEST(MicronBoot, AlivesFollowTheVendorsSequence) {
    Bench bench = powered_up();
    bench.run_to(5s);
    EXPECT_THAT(alives(bench.sent()), ElementsAre(Alive{0x80, 0x5D}, Alive{0x80, 0x4D}, Alive{0x80, 0x4D},
                                                  Alive{0x80, 0x4A}, Alive{0x80, 0x4A}));
}

TEST(MicronBoot, ParametersAreAcknowledgedAtOnceAndThenInForce) {
    Bench bench = powered_up();
    bench.run_to(4500ms);
    bench.sent();
    bench.say(continuous);
    EXPECT_THAT(alives(bench.sent()), ElementsAre(Alive{0x80, 0xCA}));
    bench.run_to(5500ms);
    EXPECT_THAT(alives(bench.sent()), ElementsAre(Alive{0x00, 0x8A}));
    for (int i = 0; i < 100; ++i)
        bench.say(continuous);  // a driver that repeats its parameters on every alive
    EXPECT_TRUE(alives(bench.sent()).empty());
    bench.run_to(5800ms);
    EXPECT_THAT(alives(bench.sent()), ElementsAre(Alive{0x00, 0x8A}));
}

TEST(MicronBoot, ParametersAreTakenWhileRecentring) {
    Bench bench = powered_up();
    bench.run_to(1200ms);
    bench.sent();
    bench.say(clockwise);
    EXPECT_THAT(alives(bench.sent()), ElementsAre(Alive{0x80, 0xDD}));
    bench.run_to(4300ms);
    EXPECT_THAT(alives(bench.sent()), ElementsAre(Alive{0x80, 0xCD}, Alive{0x80, 0xCD}, Alive{0x80, 0xCA}));
    bench.run_to(5300ms);
    EXPECT_THAT(alives(bench.sent()), ElementsAre(Alive{0x00, 0x8A}));
}

TEST(MicronBoot, RebootForgetsParametersAndBeginsAgain) {
    Bench bench = scanning(clockwise);
    bench.say(send_data);
    bench.say(reboot);
    bench.sent();
    bench.run_to(bench.now + 2s);
    const auto sent = bench.sent();
    EXPECT_THAT(alives(sent), ElementsAre(Alive{0x80, 0x5D}, Alive{0x80, 0x4D}));
    EXPECT_TRUE(lines(sent).empty()) << "the ping under way at the reboot must not be answered";
}

TEST(MicronBoot, StopAlivesLastsUntilReboot) {
    Bench bench = powered_up();
    bench.say(stop_alives);
    bench.run_to(10s);
    EXPECT_TRUE(bench.sent().empty());
    bench.say(reboot);
    bench.run_to(11s);
    EXPECT_THAT(alives(bench.sent()), ElementsAre(Alive{0x80, 0x5D}));
}

TEST(MicronBoot, UserBlockIsFollowedByFpgaMessagesOnDstOnly) {
    Bench dst = powered_up();
    dst.run_to(4s);
    dst.sent();
    dst.say(send_bb_user);
    const auto sent = dst.sent();
    ASSERT_EQ(sent.size(), 3u);
    EXPECT_EQ(sent[0].bytes.size(), 264u);
    EXPECT_EQ(sent[0].bytes[10], 6);
    EXPECT_EQ(sent[0].bytes[19], 0x0F);
    EXPECT_EQ(sent[0].bytes[146], 0) << "full duplex";
    EXPECT_EQ(sent[1].bytes.size(), 80u);
    EXPECT_EQ(sent[1].bytes[10], 63);
    EXPECT_EQ(sent[2].bytes.size(), 28u);
    EXPECT_EQ(sent[2].bytes[10], 57);
    dst.run_to(5s);
    EXPECT_THAT(alives(dst.sent()), ElementsAre(Alive{0x80, 0xCA})) << "NoParams and SentCfg";

    Bench miniking = powered_up({}, "tritech-seaking");
    miniking.run_to(4s);
    miniking.sent();
    miniking.say(send_bb_user);
    const auto other = miniking.sent();
    ASSERT_EQ(other.size(), 1u);
    EXPECT_NE(other[0].bytes[19], 0x0F);
}

TEST(MicronBoot, VersionIsAnswered) {
    Bench bench = powered_up();
    bench.say(send_version);
    const auto sent = bench.sent();
    ASSERT_EQ(sent.size(), 1u);
    EXPECT_EQ(sent[0].bytes.size(), 25u);
    EXPECT_EQ(sent[0].bytes[10], 1);
    EXPECT_EQ(u16(sent[0].bytes, 15), 21086);
}

}  // namespace
}  // namespace echoloop::test
