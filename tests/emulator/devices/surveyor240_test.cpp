// The Surveyor 240-16 on the bench: what it answers, and how what a host sets changes the pings.
#include "tests/emulator/devices/noisy_line.h"
#include "tests/emulator/devices/surveyor240_bench.h"

namespace echoloop::test {
namespace {

TEST(Surveyor240, TellsWhatItIsInBothWaysOfAsking) {
    Bench bench = surveyor();
    bench.say("42 52 02 00 06 00 00 00 04 00 a0 00");
    bench.say(frame(4));
    const auto sent = bench.sent();
    ASSERT_EQ(sent.size(), 2U);
    EXPECT_EQ(to_hex(sent[0].bytes),
              "4252060004000000"
              "c60101000000"
              "6601");
    EXPECT_EQ(sent[1].bytes, sent[0].bytes);
}

TEST(Surveyor240, RefusesRequestsForWhatItHasNot) {
    Bench bench = surveyor();
    bench.say(frame(6, "9608"));  // an Omniscan's profile
    const auto sent = bench.sent();
    ASSERT_EQ(sent.size(), 1U);
    EXPECT_EQ(u16(sent[0].bytes, 4), nack);
    EXPECT_EQ(u16(sent[0].bytes, 8), 6);
    bench.say(frame(2198));
    bench.say(frame(1, "0600"));
    EXPECT_TRUE(bench.sent().empty()) << "unknown and acknowledging frames are dropped without a word";
    Bench other = surveyor({{"nacked_id", std::string("requested")}});
    other.say(frame(6, "9608"));
    EXPECT_EQ(u16(other.sent().at(0).bytes, 8), 2198);
}

TEST(Surveyor240, IsSilentUntilItIsEnabled) {
    Bench bench = surveyor();
    bench.say(frame(6, "0500"));
    bench.run_to(3s);
    for (const Shot& shot : bench.shots)
        EXPECT_LT(shot.source_level, -200) << "it only looks at its attitude";
    Set off;
    off.enable = false;
    bench.say(frame(off));
    bench.run_to(6s);
    EXPECT_TRUE(of_id(bench.sent(), atof_points).empty());
}

TEST(Surveyor240, WhatAHostSetsIsTheNextPing) {
    Set set;
    set.start = 2000;
    set.sound_speed = 1480;
    set.steps = 800;
    set.hz = 235000;
    const Shot shot = shot_of(set);
    EXPECT_NEAR(shot.first_bin_time, 2 * 2.0 / 1480, 1e-9);
    EXPECT_EQ(shot.bins, 800U);
    EXPECT_NEAR(shot.bin_interval, 2 * 8.0 / 1480 / 800, 1e-12);
    EXPECT_NEAR(shot.pulse_length, 1.5 * shot.bin_interval, 1e-12);
    EXPECT_EQ(shot.frequency, 235000);
    ASSERT_EQ(shot.bearings.size(), 81U);
    EXPECT_NEAR(shot.bearings.front(), deg_to_rad(-40), 1e-9);
    EXPECT_NEAR(shot.bearings.back(), deg_to_rad(40), 1e-9);
    EXPECT_NEAR(shot.fan_height, deg_to_rad(4), 1e-9);
}

TEST(Surveyor240, TheStartIsAtLeastAFewPercentOfTheEnd) {
    Set set;
    for (const int start : {-5, 0, 499}) {
        set.start = start;
        EXPECT_NEAR(shot_of(set).first_bin_time, 2 * 0.5 / 1500, 1e-9) << start;
    }
}

TEST(Surveyor240, PingsComeAtThePeriodOrAsFastAsTheRangeAllows) {
    Bench bench = surveyor();
    bench.say(frame(Set{}));
    bench.run_to(bench.now);
    EXPECT_NEAR(to_seconds(bench.ping->due), 2 * 10 / 1500.0 + 0.005, 1e-6);
    bench.run_to(999ms);
    EXPECT_EQ(bench.device().counters().pings, 10U);
    Set fast;
    fast.period = 0;
    fast.end = 30000;  // 40 ms, and 5 ms of pause
    bench.say(frame(fast));
    bench.run_to(1s);
    const auto before = bench.device().counters().pings;
    bench.run_to(1s + 450ms);
    EXPECT_NEAR(static_cast<double>(bench.device().counters().pings - before), 10, 1);
    Set slow;
    slow.period = 30000;
    bench.say(frame(slow));
    bench.run_to(10s);
    const auto waiting = bench.device().counters().pings;
    bench.say(frame(Set{}));
    bench.run_to(11s);
    EXPECT_GE(bench.device().counters().pings, waiting + 10)
        << "it does not wait for the longer period to end";
}

TEST(Surveyor240, TheProcessingTimeDelaysTheReportAndTheNextPing) {
    Bench bench = surveyor({{"processing_time", 0.1}});
    bench.say(frame(Set{}));
    bench.run_to(bench.now);
    EXPECT_NEAR(to_seconds(bench.ping->due), 2 * 10 / 1500.0 + 0.1, 1e-6);
    EXPECT_NEAR(bench.ping->shot.interval, 2 * 10 / 1500.0 + 0.1, 1e-6) << "longer than the host's 100 ms";
}

TEST(Surveyor240, StoppedIsStopped) {
    Bench bench = surveyor();
    bench.say(frame(Set{}));
    bench.run_to(5ms);
    Set off;
    off.enable = false;
    bench.say(frame(off));
    bench.sent();
    bench.run_to(2s);
    EXPECT_TRUE(of_id(bench.sent(), atof_points).empty()) << "not even the ping under way";
    bench.say(frame(Set{}));
    bench.run_to(2s);
    Shot abandoned = bench.ping->shot;
    abandoned.ping = 1;
    EXPECT_TRUE(bench.device().heard(echo_of(abandoned, 0, 0), bench.now).send.empty()) << "nor too late";
    bench.run_to(2s + 50ms);
    EXPECT_EQ(of_id(bench.sent(), atof_points).size(), 1U);
}

TEST(Surveyor240, WhatCannotBeSetIsRefusedAndChangesNothing) {
    std::vector<Set> bad(12);
    bad[0].end = 100001;
    bad[1].end = -1;
    bad[2].start = 10000;
    bad[3].sound_speed = std::numeric_limits<float>::quiet_NaN();
    bad[4].sound_speed = 0;
    bad[5].gain = 101;
    bad[6].period = -1;
    bad[7].injected = 1;
    bad[8].raw = true;
    bad[9].hz = 480000;
    bad[10].steps = 801;
    bad[11].pulse = std::numeric_limits<float>::infinity();
    Bench bench = surveyor();
    for (const Set& set : bad) {
        bench.say(frame(set));
        const auto sent = bench.sent();
        ASSERT_EQ(sent.size(), 1U);
        EXPECT_EQ(u16(sent[0].bytes, 4), nack);
        EXPECT_EQ(u16(sent[0].bytes, 8), ping_parameters);
        EXPECT_GT(sent[0].bytes.size(), 20U) << "it says why";
    }
    EXPECT_EQ(bench.device().counters().rejected, bad.size());
    bench.run_to(1s);
    EXPECT_EQ(bench.device().counters().pings, 0U);
}

TEST(Surveyor240, AcknowledgesOnDemand) {
    Bench bench = surveyor();
    bench.say(frame(Set{}));
    EXPECT_TRUE(bench.sent().empty());
    Bench other = surveyor({{"acknowledge", true}});
    other.say(frame(Set{}));
    EXPECT_EQ(to_hex(other.sent().at(0).bytes),
              "4252020001000000"
              "cf0b"
              "7101");
}

TEST(Surveyor240, FlippedBytesDoNotWedgeIt) {
    Bench bench = surveyor();
    Set stop;
    stop.enable = false;
    const NoisyHost line{{to_hex(frame(Set{})), to_hex(frame(stop)), to_hex(frame(6, "c40b")),
                          to_hex(frame(15, le(1, 8) + le(2, 4)))},
                         "42520200060000000500a100",
                         [](const Send& send) { return u16(send.bytes, 4) == 5; }};
    expect_no_wedge(bench, line, 500);
}

}  // namespace
}  // namespace echoloop::test
