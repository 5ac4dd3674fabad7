// How a Ping1D's reading follows the bottom, and what its options and its firmware change.
#include <gtest/gtest.h>

#include "tests/emulator/devices/ping1d_bench.h"

namespace echoloop::test {
namespace {

using namespace std::chrono_literals;

TEST(Ping1d, TheReadingFollowsAStepLate) {
    Bench bench = ping1d();
    bench.say(manual);
    bench.say(ten_metres);
    bench.echo_power = 1e15F;
    bench.echo_bin = 100;
    bench.run_to(1s);
    EXPECT_EQ(u32(answer(bench, frame(1211)), 8), 5025);
    bench.echo_bin = 110;  // 0.5 m deeper
    const auto at = [&](Time time) {
        bench.run_to(1s + time);
        return 1e-3 * static_cast<double>(u32(answer(bench, frame(1211)), 8)) - 5.025;
    };
    // One ping after another, 100 ms apart: 1 - exp(-t / 0.3 s) of the step.
    EXPECT_NEAR(at(300ms), 0.5 * 0.632, 0.5 * 0.12);
    EXPECT_NEAR(at(800ms), 0.5 * 0.93, 0.5 * 0.04) << "0.8 s were reported";
    EXPECT_NEAR(at(3s), 0.5, 1e-3);
}

TEST(Ping1d, AfterAJumpTheReadingWaitsAndItsConfidenceFades) {
    Bench bench = ping1d();
    bench.say(manual);
    bench.say(ten_metres);
    bench.echo_power = 1e15F;
    bench.echo_bin = 50;
    bench.run_to(1s);
    bench.echo_bin = 150;  // 5 m deeper
    bench.run_to(1300ms);
    const Bytes waiting = answer(bench, frame(1211));
    EXPECT_EQ(u32(waiting, 8), 2525);
    EXPECT_NEAR(waiting[12], 50, 20);
    bench.run_to(1800ms);
    const Bytes there = answer(bench, frame(1211));
    EXPECT_EQ(u32(there, 8), 7525);
    EXPECT_EQ(there[12], 100);
    bench.echo_power = 0;
    bench.run_to(3s);
    EXPECT_EQ(answer(bench, frame(1211))[12], 0) << "no bottom any more";
}

TEST(Ping1d, AnOldOneHasNoContentInVoltageAndTemperature) {
    Bench bench = ping1d({{"firmware", std::string("3.20.0")}});
    EXPECT_EQ(to_hex(answer(bench, frame(1202))), "42520000b20401004b01");
    EXPECT_EQ(to_hex(answer(bench, frame(6, "bd04"))), "42520000bd0401005601");
    EXPECT_EQ(answer(bench, frame(1214)).size(), 12u);
}

TEST(Ping1d, IsAtPowerUpWhatItsOptionsSay) {
    Bench bench = ping1d({{"firmware", std::string("0.0.0")},
                          {"device_id", std::int64_t{0}},
                          {"device_type", std::int64_t{9}},
                          {"device_revision", std::int64_t{19}},
                          {"mode_auto", false},
                          {"scan_length", std::int64_t{1000}},
                          {"gain", std::int64_t{6}},
                          {"ping_interval", std::int64_t{1000}},
                          {"speed_of_sound", 342.0},
                          {"stream_at_start", true},
                          {"ack_continuous", false},
                          {"streamed", std::string("profile")}});
    bench.run_to(5500ms);
    const auto stream = bench.sent();
    EXPECT_EQ(ids(stream), std::vector<int>(6, 1300)) << "profiles once a second";
    EXPECT_EQ(stream[0].bytes[6], 0);
    EXPECT_EQ(to_hex(answer(bench, frame(4))).substr(16, 12), "091300000000");
    EXPECT_EQ(to_hex(answer(bench, frame(1200))).substr(16, 12), "090100000000");
    EXPECT_EQ(u32(answer(bench, frame(1203)), 8), 342000);
    EXPECT_EQ(to_hex(answer(bench, frame(1210))).substr(16, 20), "000000008813e8030600");
    bench.say(frame(1401, "1405"));
    EXPECT_TRUE(bench.sent().empty());
}

}  // namespace
}  // namespace echoloop::test
