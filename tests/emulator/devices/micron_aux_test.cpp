// The echosounder on a Micron's AUX port: pings of its own between the lines, and its ASCII in mtAuxData.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/emulator/devices/micron_bench.h"

namespace echoloop::test {
namespace {

const Options connected{{"aux_echosounder", true}, {"aux_range", 15.0}};

std::vector<std::string> depths(const std::vector<Send>& sent) {
    std::vector<std::string> found;
    for (const Send& s : sent)
        if (s.bytes.at(10) == 8) found.emplace_back(s.bytes.begin() + 15, s.bytes.end() - 1);
    return found;
}

TEST(MicronAux, NothingIsHeardUnlessItIsConnected) {
    Bench bench = scanning(clockwise);
    bench.echo_bin = 234;
    bench.echo_power = 1e15F;
    bench.run_to(bench.now + 5s);
    EXPECT_TRUE(depths(bench.sent()).empty());
}

TEST(MicronAux, DepthComesOnceASecondWhileNobodyScans) {
    Bench bench = scanning(clockwise, connected);
    bench.echo_bin = 234;  // of 10 mm
    bench.echo_power = 1e15F;
    bench.run_to(bench.now + 3100ms);
    const auto sent = bench.sent();
    EXPECT_THAT(depths(sent), testing::ElementsAre("2340mm", "2340mm", "2340mm", "2340mm"));
    EXPECT_GE(alives(sent).size(), 3u) << "mtAlive goes on";
    for (const Send& s : sent)
        if (s.bytes[10] == 8) {
            EXPECT_EQ(to_hex(s.bytes), "4030303130100002ff0b0880020600323334306d6d0a");
        }
    ASSERT_FALSE(bench.shots.empty());
    EXPECT_NEAR(bench.shots[0].tilt, -std::numbers::pi / 2, 1e-12) << "straight down";
    EXPECT_NEAR(static_cast<double>(bench.shots[0].bins) * bench.shots[0].bin_interval, 0.02, 1e-9) << "15 m";
}

TEST(MicronAux, DepthIsAppendedToALineWhoseStatusSaysSo) {
    Bench bench = scanning(clockwise, connected);
    bench.echo_bin = 234;
    bench.echo_power = 1e15F;
    for (int i = 0; i < 20; ++i) {
        bench.say(send_data);
        bench.run_to(bench.now + 60ms);
    }
    const auto sent = bench.sent();
    std::size_t appended = 0;
    for (std::size_t i = 0; i < sent.size(); ++i) {
        if (sent[i].bytes[10] != 2) continue;
        const bool flagged = (sent[i].bytes[16] & 0x80) != 0;
        const bool followed = i + 1 < sent.size() && sent[i + 1].bytes[10] == 8;
        EXPECT_EQ(flagged, followed) << i;
        appended += flagged;
    }
    EXPECT_GE(appended, 1u);
    EXPECT_GT(lines(sent).size(), 10u);
}

TEST(MicronAux, AnEchosounderThatIsNeverDoneLeavesRoomForLines) {
    Bench bench =
        scanning(clockwise, {{"aux_echosounder", true}, {"aux_range", 300.0}, {"aux_period", 0.05}});
    for (int i = 0; i < 5; ++i) {
        bench.say(send_data);
        bench.run_to(bench.now + 1s);
    }
    EXPECT_GE(lines(bench.sent()).size(), 8u);
    EXPECT_GE(bench.shots.size(), 12u) << "and lines leave room for the echosounder";
}

TEST(MicronAux, NoBottomNoMessage) {
    Bench bench = scanning(clockwise, connected);
    bench.run_to(bench.now + 3100ms);
    EXPECT_TRUE(depths(bench.sent()).empty());
    EXPECT_GE(bench.shots.size(), 3u);
}

TEST(MicronAux, RebootEndsItUntilParametersCome) {
    Bench bench = scanning(clockwise, connected);
    bench.run_to(bench.now + 100ms);
    bench.shots.clear();
    bench.say(reboot);
    bench.run_to(bench.now + 8s);
    EXPECT_TRUE(bench.shots.empty());
}

}  // namespace
}  // namespace echoloop::test
