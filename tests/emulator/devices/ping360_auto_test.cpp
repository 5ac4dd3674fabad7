// Automatic scans of the Ping360: where they go, how fast, what ends them, and which firmware has them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numeric>

#include "tests/emulator/devices/ping360_bench.h"

namespace echoloop::test {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::ElementsAreArray;

std::vector<int> first_angles(std::size_t count, int start, int stop, int step) {
    Bench bench = ping360();
    bench.say(auto_transmit(start, stop, step));
    bench.run_to(30s);
    auto found = angles(bench.sent());
    found.resize(count);
    return found;
}

TEST(Ping360Auto, AFullCircleGoesOnFromItsStart) {
    Bench bench = ping360();
    bench.say(auto_transmit(0, 399, 1));
    // 402 pings of 2R/c = 2.64 ms and 6 ms of motor
    bench.run_to(from_seconds(402 * 0.00864));
    std::vector<int> expected(400);
    std::iota(expected.begin(), expected.end(), 0);
    const auto sent = bench.sent();
    auto found = angles(sent);
    EXPECT_EQ(sent[0].bytes.size(), 1230u);
    EXPECT_EQ(to_hex(ByteView(sent[7].bytes).subspan(18, 6)), "00008f010100");
    ASSERT_GE(found.size(), 402u);
    EXPECT_EQ(found[400], 0);
    found.resize(400);
    EXPECT_THAT(found, ElementsAreArray(expected));
}

TEST(Ping360Auto, ASectorIsSweptToAndFroThroughZero) {
    Bench bench = ping360();
    bench.say(auto_transmit(390, 8, 5));
    bench.run_to(1s);
    auto found = angles(bench.sent());
    found.resize(10);
    EXPECT_THAT(found, ElementsAre(390, 395, 0, 5, 8, 3, 398, 393, 390, 395)) << "each end once";
    Bench twice = ping360({{"turn_around", std::string("twice")}});
    twice.say(auto_transmit(10, 20, 5));
    twice.run_to(1s);
    found = angles(twice.sent());
    found.resize(7);
    EXPECT_THAT(found, ElementsAre(10, 15, 20, 20, 15, 10, 10));
}

TEST(Ping360Auto, AWideSectorIsSweptOneWay) {
    // As a scan in the field: 0, 10 .. 300, 0.
    const auto wide = first_angles(33, 0, 300, 10);
    EXPECT_EQ(wide[29], 290);
    EXPECT_EQ(wide[30], 300);
    EXPECT_EQ(wide[31], 0);
    EXPECT_EQ(wide[32], 10);
    EXPECT_THAT(first_angles(5, 350, 50, 50), ElementsAre(350, 0, 50, 0, 350)) << "90 deg: to and fro";
}

TEST(Ping360Auto, StepsBeyondTheDocumentedOnesAreTaken) {
    EXPECT_THAT(first_angles(4, 0, 5, 10), ElementsAre(0, 5, 0, 5)) << "a step beyond the stop";
    EXPECT_THAT(first_angles(4, 0, 399, 100), ElementsAre(0, 100, 200, 300));
    EXPECT_THAT(first_angles(5, 0, 399, 246), ElementsAre(0, 390, 380, 370, 360)) << "-10";
    EXPECT_THAT(first_angles(5, 20, 0, 246), ElementsAre(20, 10, 0, 10, 20));
    EXPECT_THAT(first_angles(3, 0, 399, 128), ElementsAre(0, 272, 144)) << "-128";
}

TEST(Ping360Firmware, ServesWhatItsVersionKnows) {
    Bench old = ping360({{"firmware", std::string("3.1.0")}});
    old.say(auto_transmit(0, 399, 1));
    old.say(frame(6, "fd08"));  // 2301
    old.say(frame(5));
    old.say(transducer(0));
    old.run_to(1s);
    const auto sent = old.sent();
    ASSERT_THAT(ids(sent), ElementsAre(2, 2, 5, 2300));
    EXPECT_EQ(u16(sent[0].bytes, 8), 2602);
    EXPECT_EQ(to_hex(ByteView(sent[2].bytes).subspan(8, 3)), "010000");
    Bench last = ping360({{"firmware", std::string("3.3.0")}});
    last.say(auto_transmit(0, 399, 1));
    EXPECT_THAT(ids(last.sent()), ElementsAre(2));
    Bench named = ping360({{"protocol_version", std::string("1.0.0")}});
    named.say(frame(5));
    EXPECT_EQ(to_hex(ByteView(named.sent().at(0).bytes).subspan(8, 3)), "010000");
}

TEST(Ping360Auto, EndsOnEverythingThatEndsIt) {
    const std::vector<std::pair<const char*, Bytes>> ends{
        {"motor off", motor_off}, {"reset", frame(2600, "0000")}, {"mark", {0x55}}};
    for (const auto& [name, bytes] : ends) {
        Bench bench = ping360();
        bench.say(auto_transmit(0, 399, 1));
        bench.run_to(300ms);
        bench.say(bytes);
        bench.sent();
        bench.run_to(2s);
        EXPECT_TRUE(bench.sent().empty()) << name;
    }
    Bench bench = ping360();
    bench.say(auto_transmit(0, 399, 1));
    bench.run_to(300ms);
    bench.device().reconnected(0);
    bench.sent();
    bench.run_to(2s);
    EXPECT_TRUE(bench.sent().empty()) << "closed port";
    bench.say(auto_transmit(100, 101, 1));
    bench.say(transducer(7));
    bench.run_to(6s);
    EXPECT_THAT(angles(bench.sent()), ElementsAre(7))
        << "another command, and no frame of the scan before it";
}

TEST(Ping360Auto, TheDelayAndTheLineComeBetweenPings) {
    Bench bench = ping360({{"baud", 115200.0}});
    bench.say(auto_transmit(0, 399, 1, 50));
    bench.run_to(10s);
    // 2R/c 2.64 ms, motor 6 ms, 1230 bytes 106.8 ms, delay 50 ms
    EXPECT_NEAR(static_cast<double>(bench.shots.size()), 10 / (0.00264 + 0.006 + 12300 / 115200.0 + 0.05),
                1.5);
}

}  // namespace
}  // namespace echoloop::test
