// What is not known of a real Ping360 is an option: each of its words makes the difference that it names.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "tests/emulator/devices/ping360_bench.h"

namespace echoloop::test {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::IsEmpty;

Options word(const std::string& name, const std::string& value) { return {{name, value}}; }

/// Bearing in degrees of the ping at an angle, clockwise from the mount's x axis.
double bearing(const Options& changes, int angle) {
    Bench bench = ping360(changes);
    bench.say(transducer(angle));
    bench.run_to(4s);
    return -rad_to_deg(bench.shots.at(0).pan);
}

std::string answer(const Options& changes, const Bytes& question) {
    Bench bench = ping360(changes);
    bench.say(question);
    const auto sent = bench.sent();
    return sent.empty() ? "" : to_hex(sent[0].bytes);
}

TEST(Ping360Options, IdentityIsWhatHostsReadBack) {
    EXPECT_EQ(answer({}, frame(4)).substr(16, 12), "020103030800");
    EXPECT_EQ(answer({{"firmware", std::string("3.1.1")},
                      {"device_type", std::int64_t{9}},
                      {"device_revision", std::int64_t{7}}},
                     frame(4))
                  .substr(16, 12),
              "090703010100");
    EXPECT_EQ(answer(word("protocol_version", "1.1.0"), frame(5)).substr(16, 8), "01010000");
}

TEST(Ping360Options, SettingAnIdIsAnsweredAsTheOptionsSay) {
    const std::string ack = answer({}, frame(2000, "0500"));
    EXPECT_EQ(ack.substr(8, 4), "0100");
    EXPECT_EQ(ack.substr(12, 2), "05") << "from its new id";
    EXPECT_EQ(ack.substr(16, 4), "d007");
    EXPECT_EQ(answer(word("set_id_reply", "none"), frame(2000, "0500")), "");
    EXPECT_EQ(answer({}, frame(2000, "0000")).substr(8, 4), "0200") << "no device is called 0";
    EXPECT_EQ(answer({}, frame(100, "05")).substr(8, 4), "0200");
    const std::string accepted = answer(word("common_set_id", "ack"), frame(100, "05"));
    EXPECT_EQ(accepted.substr(8, 4), "0100");
    EXPECT_EQ(accepted.substr(16, 4), "6400");
}

TEST(Ping360Options, DataOnRequestIsEmptyOrTheLast) {
    for (const bool last : {false, true}) {
        Bench bench = ping360(word("data_on_request", last ? "last" : "empty"));
        bench.say(auto_transmit(100, 120, 5, 3));
        bench.run_to(2s);
        bench.say(motor_off);
        const int angle = angles(bench.sent()).back();
        bench.say(frame(6, "fc08"));  // 2300
        bench.say(frame(2301));
        const auto sent = bench.sent();
        ASSERT_EQ(sent.size(), 2u);
        EXPECT_EQ(angles(sent)[0], angle);
        EXPECT_EQ(angles(sent)[1], angle);
        EXPECT_EQ(sent[0].bytes.size(), 24u + (last ? 1200 : 0));
        EXPECT_EQ(sent[1].bytes.size(), 30u + (last ? 1200 : 0));
        EXPECT_EQ(to_hex(ByteView(sent[1].bytes).subspan(18, 6)), "640078000503") << "100 to 120 by 5, 3 ms";
    }
}

TEST(Ping360Options, DataOnRequestBeforeAnyPingTellsTheSettingsOfPowerUp) {
    // mode 1, gain 0, angle 0, 32 us, 80 ticks, 740 kHz, 0 to 399 by 1, delay 0, 1024 samples, none of them
    // here
    const std::string settings =
        "0100"
        "0000"
        "2000"
        "5000"
        "e402"
        "00008f01"
        "0100"
        "0004"
        "0000";
    EXPECT_EQ(answer({}, frame(6, "fd08")).substr(16, 40), settings);
    EXPECT_EQ(answer({}, frame(2301)).substr(16, 40), settings);
}

TEST(Ping360Options, TheMountTurnsTheZeroAndTheSense) {
    EXPECT_NEAR(bearing({}, 200), 0, 1e-9) << "the arrow is ahead";
    EXPECT_NEAR(bearing({}, 250), -45, 1e-9);
    EXPECT_NEAR(bearing(word("rotation", "counter-clockwise"), 250), 45, 1e-9);
    EXPECT_NEAR(bearing({{"forward_angle", std::int64_t{0}}}, 50), -45, 1e-9) << "zero is ahead";
    EXPECT_NEAR(bearing({{"forward_angle", std::int64_t{30}}}, 130), -90, 1e-9);
}

TEST(Ping360Options, TheMotorIsAsFastAsItIsSaidToBe) {
    for (const double turn : {2.4, 4.0, 40.0}) {
        Bench bench = ping360({{"turn_time", turn}});
        bench.say(transducer(100));
        EXPECT_NEAR(to_seconds(bench.wake), turn / 4, 1e-6);
    }
}

TEST(Ping360Options, MarksAreBreaksOrNoise) {
    for (const bool on : {true, false}) {
        Bench bench = ping360({{"marks_are_breaks", on}});
        bench.say(auto_transmit(0, 399, 1));
        bench.run_to(100ms);
        bench.say("55555555");
        bench.sent();
        bench.run_to(200ms);
        EXPECT_EQ(bench.sent().empty(), on);
    }
}

TEST(Ping360Options, ALineHasTheRateThatItIsGiven) {
    for (const double baud : {115200.0, 921600.0}) {
        Bench bench = ping360({{"baud", baud}});
        for (int i = 0; i < 10; ++i) bench.say(transducer(0));
        bench.run_to(10s);
        EXPECT_EQ(bench.shots.size(), 10u);
        bench.sent();
        const Time before = bench.now;
        bench.say(transducer(0));
        bench.say(transducer(0));
        while (bench.shots.size() < 12) bench.run_to(bench.now + 1ms);
        // the second ping begins when the 1224 bytes of the first have left
        EXPECT_NEAR(to_seconds(bench.now - before), 12240 / baud + 2 * 0.00264, 0.002) << baud;
    }
}

TEST(Ping360Options, StartToStopOf400IsAFullCircleToo) {
    Bench bench = ping360();
    bench.say(auto_transmit(0, 400, 10));
    bench.run_to(4s);
    const auto found = angles(bench.sent());
    ASSERT_GT(found.size(), 41u);
    EXPECT_EQ(found[39], 390);
    EXPECT_EQ(found[40], 0) << "on through zero";
    EXPECT_EQ(found[41], 10);
}

}  // namespace
}  // namespace echoloop::test
