// The points of a Surveyor 240-16 on the bench, and what it makes of them for the next ping.
#include "tests/emulator/devices/surveyor240_bench.h"

namespace echoloop::test {
namespace {

TEST(Surveyor240, PointsAreAnglesToPortAndTimesOfFlight) {
    Bench bench = surveyor();
    bench.run_to(61250ms);
    Set set;
    set.yz = true;
    bench.say(frame(set));
    bench.run_to(bench.now);
    const Shot shot = bench.ping->shot;
    place_echo(bench, shot, 7);
    bench.sent();
    bench.run_to(bench.ping->due);
    const auto sent = bench.sent();
    const auto atof = of_id(sent, atof_points), yz = of_id(sent, yz_points);
    ASSERT_EQ(atof.size(), 1U);
    ASSERT_EQ(yz.size(), 1U);
    const Bytes &a = atof[0].bytes, &b = yz[0].bytes;
    EXPECT_EQ(u32(a, 8), 61250U);
    EXPECT_EQ(number_at(a, 12, 8), 0U) << "no host has told the time";
    EXPECT_NEAR(f32(a, 20), 2 * 10 / 1500.0, 1e-7);
    EXPECT_EQ(f32(a, 24), 1500);
    EXPECT_EQ(u32(a, 28), 1U);
    EXPECT_EQ(u32(a, 32), 240000U);
    EXPECT_NEAR(f32(a, 36), shot.pulse_length, 1e-9);
    ASSERT_EQ(u16(a, 44), 15);
    ASSERT_EQ(a.size(), 8U + 40 + 15 * 16 + 2);
    ASSERT_EQ(u16(b, 106), 15);
    ASSERT_EQ(b.size(), 8U + 100 + 15 * 8 + 2);
    EXPECT_EQ(u32(b, 12), 1U);
    EXPECT_EQ(f32(b, 84), -1000) << "no sensors";
    EXPECT_EQ(f32(b, 88), -1000);
    EXPECT_NEAR(f32(b, 96), 0.5, 1e-6);
    EXPECT_NEAR(f32(b, 100), 10, 1e-6);
    float last = 1;
    for (std::size_t n = 0; n < 15; ++n) {
        const float angle = f32(a, 48 + 16 * n), time = f32(a, 52 + 16 * n);
        EXPECT_LT(angle, last) << "port first";
        last = angle;
        // The echo fills a bin, and the middle of a pulse's echo comes half a pulse late.
        EXPECT_NEAR(time, 2 * 7 / 1500.0 - shot.pulse_length / 2, shot.bin_interval);
        const float d = 1500 * time / 2;
        EXPECT_NEAR(f32(b, 108 + 8 * n), d * std::sin(angle), 1e-4);
        EXPECT_NEAR(f32(b, 112 + 8 * n), -d * std::cos(angle), 1e-4);
    }
    EXPECT_NEAR(f32(a, 48), deg_to_rad(40), deg_to_rad(6));
}

TEST(Surveyor240, OneDirectionIsOnePointOnItsSideByTheHostsSpeedOfSound) {
    Bench bench = surveyor();
    Set set;
    set.yz = true;
    set.sound_speed = 1480;
    bench.say(frame(set));
    bench.run_to(bench.now);
    Echogram echogram = echo_of(bench.ping->shot, 0, 0);
    echogram.values[70 * echogram.shot.bins + 200] = 1e13F;  // 30 deg to starboard
    const auto sent = bench.device().heard(echogram, bench.now + 20ms).send;
    const Bytes atof = of_id(sent, atof_points).at(0).bytes, yz = of_id(sent, yz_points).at(0).bytes;
    ASSERT_EQ(u16(atof, 44), 1);
    EXPECT_NEAR(f32(atof, 48), deg_to_rad(-30), 1e-6);
    EXPECT_NEAR(std::atan2(f32(yz, 108), -f32(yz, 112)), deg_to_rad(-30), 1e-6);
    EXPECT_NEAR(std::hypot(f32(yz, 108), f32(yz, 112)), 1480 * f32(atof, 52) / 2, 1e-5);
}

TEST(Surveyor240, EachKindOfPointsIsSentIfItIsEnabled) {
    for (const bool yz : {false, true}) {
        Bench bench = surveyor();
        Set set;
        set.yz = yz;
        set.atof = !yz;
        bench.say(frame(set));
        bench.run_to(50ms);
        const auto sent = bench.sent();
        EXPECT_EQ(of_id(sent, yz_points).size(), yz ? 1U : 0U);
        EXPECT_EQ(of_id(sent, atof_points).size(), yz ? 0U : 1U);
    }
}

TEST(Surveyor240, WhatSideLobesHearIsNoPoint) {
    Bench bench = surveyor();
    bench.say(frame(Set{}));
    bench.run_to(bench.now);
    Echogram echogram = echo_of(bench.ping->shot, 0, 0);
    const auto put = [&](std::size_t direction, std::size_t bin, float power) {
        echogram.values[direction * echogram.shot.bins + bin] = power;
    };
    put(40, 200, 1e13F);
    put(60, 200, 1e9F);  // 40 dB less at the same time
    put(10, 300, 1e9F);
    std::vector<float> angles;
    for (const Send& send : bench.device().heard(echogram, bench.now + 20ms).send)
        if (u16(send.bytes, 4) == atof_points)
            for (int n = 0; n < u16(send.bytes, 44); ++n)
                angles.push_back(f32(send.bytes, 48 + 16 * static_cast<std::size_t>(n)));
    ASSERT_EQ(angles.size(), 2U);
    EXPECT_NEAR(angles[0], deg_to_rad(30), 1e-6);
    EXPECT_NEAR(angles[1], 0, 1e-6);
}

/// Points of an echo over eight range steps, 35 deg to port.
int points_of_echo_at(std::size_t first_bin) {
    Bench bench = surveyor();
    bench.say(frame(Set{}));
    bench.run_to(bench.now);
    Echogram echogram = echo_of(bench.ping->shot, 0, 0);
    for (std::size_t bin = first_bin; bin < first_bin + 8; ++bin)
        echogram.values[5 * echogram.shot.bins + bin] = 1e13F;
    const auto sent = of_id(bench.device().heard(echogram, bench.now + 20ms).send, atof_points);
    return u16(sent.at(0).bytes, 44);
}

TEST(Surveyor240, AnEchoThatTheRangeMayHaveCutIsNoPoint) {
    EXPECT_EQ(points_of_echo_at(300), 1);
    EXPECT_EQ(points_of_echo_at(392), 0) << "its middle is not that of the bottom";
    EXPECT_EQ(points_of_echo_at(0), 0);
}

TEST(Surveyor240, HowManyPointsIsAnOption) {
    for (const std::int64_t most : {1, 40, 256}) {
        Bench bench = surveyor({{"points", most}});
        bench.say(frame(Set{}));
        bench.run_to(bench.now);
        place_echo(bench, bench.ping->shot, 7);
        bench.run_to(50ms);
        const auto sent = of_id(bench.sent(), atof_points);
        ASSERT_EQ(sent.size(), 1U);
        EXPECT_EQ(u16(sent[0].bytes, 44), std::min<std::int64_t>(most, 81));
    }
}

TEST(Surveyor240, WithoutABottomThereAreNoPointsButAMessage) {
    Bench bench = surveyor();
    bench.say(frame(Set{}));
    bench.run_to(50ms);
    const auto sent = of_id(bench.sent(), atof_points);
    ASSERT_EQ(sent.size(), 1U);
    EXPECT_EQ(u16(sent[0].bytes, 44), 0);
    EXPECT_EQ(sent[0].bytes.size(), 50U);
}

TEST(Surveyor240, DataOfTheLastPingIsThereOnRequest) {
    Bench bench = surveyor();
    bench.say(frame(6, le(atof_points, 2)));
    EXPECT_EQ(u16(bench.sent().at(0).bytes, 44), 0) << "none yet";
    Set quiet;
    quiet.atof = false;
    bench.say(frame(quiet));
    bench.run_to(bench.now);
    place_echo(bench, bench.ping->shot, 7);
    bench.run_to(50ms);
    EXPECT_TRUE(of_id(bench.sent(), atof_points).empty()) << "neither kind is enabled";
    bench.say(frame(atof_points));
    bench.say(frame(6, le(yz_points, 2)));
    const auto sent = bench.sent();
    EXPECT_EQ(u16(sent.at(0).bytes, 44), 15);
    EXPECT_EQ(u16(sent.at(1).bytes, 106), 15);
}

TEST(Surveyor240, FollowsTheBottomWhereTheHostLeavesTheRangeToIt) {
    Bench bench = surveyor();
    Set set;
    set.end = 0;
    set.start = 3000;
    bench.say(frame(set));
    std::vector<double> ends;
    const auto next_ping = [&] {
        while (!bench.ping || bench.ping->shot.ping == 0)
            bench.run_to(std::min(bench.wake, bench.now + 10ms));
        const Shot& shot = bench.ping->shot;
        const double first = shot.first_bin_time * 750;
        ends.push_back(first + shot.bin_interval * static_cast<double>(shot.bins) * 750);
        EXPECT_NEAR(first, 0.05 * ends.back(), 1e-6) << "the host's start does not count";
        if (ends.back() > 45) place_echo(bench, shot, 45);
        bench.run_to(bench.ping->due);
    };
    for (int i = 0; i < 6; ++i) next_ping();
    using testing::DoubleNear;
    EXPECT_THAT(std::vector(ends.begin(), ends.begin() + 3),
                testing::ElementsAre(DoubleNear(10, 1e-6), DoubleNear(20, 1e-6), DoubleNear(40, 1e-6)));
    EXPECT_NEAR(ends[4], 1.25 * 45, 0.5) << "a quarter more than the farthest point";
    EXPECT_NEAR(ends[5], ends[4], 1e-9) << "it stays while the bottom is in its middle";
}

TEST(Surveyor240, TheSearchForABottomEndsAndBeginsAgain) {
    Bench bench = surveyor();
    Set set;
    set.end = 0;
    bench.say(frame(set));
    bench.run_to(3s);
    double longest = 0;
    int restarts = 0;
    for (const Shot& shot : bench.shots) {
        const double end = 750 * (shot.first_bin_time + shot.bin_interval * static_cast<double>(shot.bins));
        if (end < longest / 5) ++restarts;
        longest = std::max(longest, end);
    }
    EXPECT_NEAR(longest, 100, 1e-6);
    EXPECT_GT(restarts, 1);
}

TEST(Surveyor240, TheGainMovesWhereTheInputClips) {
    Set set;
    set.gain = 0;
    const double low = shot_of(set).receiver.saturation_level;
    set.gain = 100;
    EXPECT_NEAR(low - shot_of(set).receiver.saturation_level, 60, 1e-9);
    Bench bench = surveyor();
    bench.say(frame(Set{}));
    bench.run_to(bench.now);
    place_echo(bench, bench.ping->shot, 7, 1e14F);  // 140 dB
    bench.run_to(120ms);
    ASSERT_GE(bench.shots.size(), 2U);
    EXPECT_NEAR(bench.shots.back().receiver.saturation_level, 140 + 12, 1)
        << "automatic, 12 dB above the loudest";
}

}  // namespace
}  // namespace echoloop::test
