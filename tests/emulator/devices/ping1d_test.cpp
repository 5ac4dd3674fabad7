// The Ping1D on the bench: literal frames of the published definitions in, replies read by their offsets out.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/emulator/devices/ping1d_bench.h"

namespace echoloop::test {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;

TEST(Ping1d, EveryGetMessageComesByBothKindsOfRequest) {
    const std::map<int, std::size_t> payloads{{4, 6},    {5, 4},     {1200, 6},   {1201, 1},  {1202, 2},
                                              {1203, 4}, {1204, 8},  {1205, 1},   {1206, 2},  {1207, 4},
                                              {1208, 2}, {1210, 10}, {1211, 5},   {1212, 24}, {1213, 2},
                                              {1214, 2}, {1215, 1},  {1300, 226}, {1301, 4}};
    Bench bench = ping1d();
    bench.run_to(50ms);
    for (const auto& [id, size] : payloads) {
        const Bytes request{static_cast<std::uint8_t>(id), static_cast<std::uint8_t>(id >> 8)};
        for (const Bytes& question : {frame(id), frame(6, to_hex(request))}) {
            const Bytes reply = answer(bench, question);
            EXPECT_EQ(u16(reply, 4), id);
            EXPECT_EQ(reply.size(), size + 10) << id;
            EXPECT_EQ(reply[6], 1) << "its own id";
        }
    }
    EXPECT_EQ(to_hex(answer(bench, frame(1200))),
              "42520600b0040100"
              "010103001c00"
              "7001");
}

TEST(Ping1d, SetsAreAcknowledgedAndReadBack) {
    struct Case {
        int set;
        const char* value;
        int get;
        const char* read;
    };
    const Case cases[] = {{1003, "00", 1205, "00"},
                          {1001, "e803000010270000", 1204, "e803000010270000"},
                          {1002, "a0081600", 1203, "a0081600"},
                          {1004, "2400", 1206, "2400"},
                          {1005, "06", 1207, "06000000"},
                          {1006, "00", 1215, "00"},
                          {1007, "64000100", 1301, "64000100"},
                          {1000, "2b", 1201, "2b"}};
    Bench bench = ping1d();
    for (const Case& c : cases) {
        const Bytes ack = answer(bench, frame(c.set, c.value));
        EXPECT_EQ(u16(ack, 4), 1) << c.set;
        EXPECT_EQ(u16(ack, 8), c.set);
        const Bytes reply = answer(bench, frame(c.get));
        EXPECT_EQ(to_hex(ByteView(reply).subspan(8, reply.size() - 10)), c.read) << c.set;
    }
}

TEST(Ping1d, WhatDoesNotFitIsRefusedWithAText) {
    Bench bench = ping1d();
    EXPECT_EQ(u16(answer(bench, ten_metres), 4), 2) << "range is automatic";
    bench.say(manual);
    EXPECT_EQ(u16(answer(bench, ten_metres), 4), 1);
    const Bytes nack = answer(bench, frame(1001, "00000000e7030000"));  // 999 mm
    EXPECT_EQ(u16(nack, 8), 1001);
    EXPECT_EQ(std::string(nack.begin() + 10, nack.end() - 3), "Range scan length out of range");
    EXPECT_EQ(u16(answer(bench, frame(1005, "07")), 4), 2);
    EXPECT_EQ(u16(answer(bench, frame(1002, "00000000")), 4), 2) << "no sound at all";
    EXPECT_EQ(u16(answer(bench, frame(1400, "b304")), 4), 2) << "no stream of 1203";
    EXPECT_EQ(u16(answer(bench, frame(6, "fc08")), 8), 6);
    bench.say(frame(4321));
    EXPECT_TRUE(bench.sent().empty()) << "unknown ids are dropped";
}

TEST(Ping1d, APingCoversTheRangeByTheHostsSpeedOfSound) {
    Bench bench = ping1d();
    bench.run_to(90ms);
    bench.say(manual);
    bench.say(frame(1001, "e803000010270000"));  // 1 to 11 m
    bench.say(frame(1002, "80841e00"));          // 2000 m/s
    bench.run_to(300ms);
    const Shot& shot = bench.shots.back();
    EXPECT_DOUBLE_EQ(shot.first_bin_time, 0.001);
    EXPECT_EQ(shot.bins, 200u);
    EXPECT_NEAR(shot.bin_interval, 0.01 / 200, 1e-12);
    EXPECT_EQ(shot.horizontal.shape, ApertureShape::piston);
}

TEST(Ping1d, DistanceAndConfidenceComeFromTheEcho) {
    Bench bench = ping1d({{"tracking_lag", 0.0}});
    bench.say(manual);
    bench.echo_bin = 100;
    bench.echo_power = 1e15F;
    bench.run_to(250ms);
    const Bytes reply = answer(bench, frame(1211));
    EXPECT_EQ(u32(reply, 8), 5025) << "middle of bin 100 of 200 in 10 m";
    EXPECT_EQ(reply[12], 100);
    const Bytes profile = answer(bench, frame(1300));
    EXPECT_EQ(u32(profile, 8), 5025);
    EXPECT_EQ(u32(profile, 24), 10000);
    // 150 + 20 log 5.025 + 2 * 0.038 * 5.025 + 20 log 12.9 - 140 = 46.62 dB of 60
    EXPECT_EQ(profile[34 + 100], std::lround(255 * 46.617 / 60));
    bench.echo_bin = 3;  // 0.175 m
    bench.run_to(500ms);
    EXPECT_EQ(answer(bench, frame(1211))[12], 0) << "too near to be the bottom";
    bench.echo_power = 0;
    bench.run_to(700ms);
    EXPECT_EQ(answer(bench, frame(1211))[12], 0) << "no echo";
}

TEST(Ping1d, InAutomaticModeTheRangeFollowsTheBottom) {
    Bench bench = ping1d();
    bench.run_to(1s);
    EXPECT_EQ(u32(answer(bench, frame(1204)), 12), 100000) << "no bottom: as far as it goes";
    bench.echo_bin = 70;  // of 200: more than a third of every range
    bench.echo_power = 1e15F;
    bench.run_to(3s);
    EXPECT_EQ(u32(answer(bench, frame(1204)), 12), 2000);
    EXPECT_LT(u32(answer(bench, frame(1207)), 8), 6) << "less gain for a loud echo";
}

TEST(Ping1d, AStreamComesAfterEveryPingUntilItIsStopped) {
    for (const int id : {1211, 1212, 1300}) {
        Bench bench = ping1d();
        const Bytes asked{static_cast<std::uint8_t>(id), static_cast<std::uint8_t>(id >> 8)};
        bench.say(frame(1004, "3200"));  // 50 ms, as one autopilot has it
        bench.say(manual);
        bench.run_to(200ms);
        EXPECT_EQ(u16(answer(bench, frame(1400, to_hex(asked))), 8), 1400);
        bench.run_to(1210ms);
        const auto sent = bench.sent();
        EXPECT_NEAR(static_cast<double>(sent.size()), 20, 1);
        EXPECT_EQ(u16(sent.back().bytes, 4), id);
        bench.say(frame(1401, to_hex(asked)));
        bench.sent();
        bench.run_to(2s);
        EXPECT_TRUE(bench.sent().empty());
    }
    Bench bench = ping1d({{"streamed", std::string("profile")}, {"ack_continuous", false}});
    bench.say(frame(1400, "bb04"));
    bench.run_to(50ms);
    EXPECT_THAT(ids(bench.sent()), ElementsAre(1300));
}

TEST(Ping1d, ASlowLineHoldsThePingsBackSoThatNoProfileGrowsOld) {
    const auto profiles = [](const std::string& endpoint, double baud) {
        Bench bench(make_device("ping1d", {endpoint}, {{"baud", baud}, {"ping_interval", std::int64_t{50}}}));
        bench.say(frame(1400, "1405"));
        bench.run_to(10s);
        return static_cast<double>(bench.sent().size());
    };
    EXPECT_NEAR(profiles("pty:/tmp/a", 9600), 10 / (236 * 10 / 9600.0), 3) << "236 bytes are 246 ms";
    EXPECT_NEAR(profiles("serial:///dev/ttyS0:9600", 0), 10 / (236 * 10 / 9600.0), 3);
    EXPECT_GT(profiles("serial:///dev/ttyS0", 0), 60) << "115200";
    EXPECT_GT(profiles("pty:/tmp/a", 0), 60);
}

TEST(Ping1d, DisabledItDoesNotPingAndAgainEnabledItDoes) {
    Bench bench = ping1d();
    bench.run_to(50ms);
    bench.say(frame(1006, "00"));
    bench.run_to(1s);
    EXPECT_EQ(bench.shots.size(), 1u);
    bench.say(frame(1006, "01"));
    bench.run_to(2s);
    EXPECT_GT(bench.shots.size(), 5u);
}

TEST(Ping1d, TheRingDownLastsAsMuchLongerAsThePulse) {
    Bench bench = ping1d({{"mode_auto", false},
                          {"scan_length", std::int64_t{100000}},
                          {"tracking_lag", 0.0}});  // 533 us: 0.4 m
    bench.echo_bin = 1;                             // 0.5 to 1 m
    bench.echo_power = 1e15F;
    bench.run_to(300ms);
    EXPECT_EQ(answer(bench, frame(1211))[12], 0) << "0.5 m are in the ring-down";
    bench.echo_bin = 2;
    bench.run_to(600ms);
    EXPECT_EQ(answer(bench, frame(1211))[12], 100);
}

TEST(Ping1d, EveryHostsWayToBeginEndsWithAnAnswer) {
    const char* const beginnings[] = {"",
                                      "55",                      // the maker's Python package, an Arduino
                                      "5555555555555555555500",  // the maker's C++ library
                                      "55555555555555555555",    // its viewer
                                      "5a48000048b8a5",          // its look for a boot loader
                                      "55555555555555555555555a48000048b8a5",
                                      "42520a00",  // half a frame, then nothing for long
                                      "425202000600000005555555555555"};  // half a frame and a break
    for (const char* const beginning : beginnings) {
        Bench bench = ping1d();
        bench.run_to(50ms);
        bench.say(beginning);
        bench.run_to(60ms);
        EXPECT_EQ(to_hex(answer(bench, frame(6, "0500"))), "4252040005000100010000009f00") << beginning;
        EXPECT_EQ(u16(answer(bench, frame(4)), 4), 4) << beginning;
    }
}

TEST(Ping1d, AHostThatClosesAndOpensTheLineIsServedAtOnce) {
    Bench bench = ping1d();
    for (int rate = 0; rate < 10; ++rate) {
        bench.say("42520200");  // half a request at a wrong rate
        bench.device().reconnected(0);
        EXPECT_EQ(u16(answer(bench, frame(6, "0400")), 4), 4);
    }
}

TEST(Ping1d, InTheBootLoaderItIsSilentThenAsAtPowerUp) {
    Bench bench = ping1d();
    bench.say(manual);
    bench.say(frame(1100));
    bench.sent();
    bench.run_to(4s);
    bench.say(frame(4));
    EXPECT_TRUE(bench.sent().empty());
    bench.run_to(6s);
    EXPECT_EQ(answer(bench, frame(1205))[8], 1) << "automatic again";
}

}  // namespace
}  // namespace echoloop::test
