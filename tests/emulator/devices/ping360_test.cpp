// The Ping360 on the bench: literal frames of the published definitions in, replies read by their offsets
// out.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>
#include <numeric>

#include "tests/emulator/devices/ping360_bench.h"

namespace echoloop::test {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::ElementsAreArray;

TEST(Ping360, AnswersRequestsOfBothKindsAsDevice2) {
    Bench bench = ping360();
    bench.say("42 52 02 00 06 00 00 00 05 00 a1 00");  // protocol version
    bench.say(frame(4));                               // device information, the older way
    const auto sent = bench.sent();
    ASSERT_EQ(sent.size(), 2u);
    EXPECT_EQ(to_hex(sent[0].bytes),
              "42520400050002000101000"
              "0a100");
    EXPECT_EQ(to_hex(sent[1].bytes),
              "425206000400020002010303"
              "0800b100");
}

TEST(Ping360, RefusesWhatItDoesNotKnowWithAText) {
    Bench bench = ping360();
    bench.say(frame(6, "b304"));  // distance of a Ping1D
    bench.say(frame(100, "07"));
    bench.say(frame(4321));
    const auto sent = bench.sent();
    EXPECT_THAT(ids(sent), ElementsAre(2, 2, 2));
    EXPECT_EQ(u16(sent[0].bytes, 8), 6);
    EXPECT_EQ(u16(sent[1].bytes, 8), 100);
    EXPECT_EQ(u16(sent[2].bytes, 8), 4321);
    EXPECT_EQ(std::string(sent[1].bytes.begin() + 10, sent[1].bytes.end() - 3), "command not recognised");
    bench.say(frame(2, "0600"));
    EXPECT_TRUE(bench.sent().empty()) << "a nack is never answered";
    Bench other = ping360({{"nacked_id", std::string("requested")}});
    other.say(frame(6, "b304"));
    EXPECT_EQ(u16(other.sent().at(0).bytes, 8), 1203);
}

TEST(Ping360, PingFollowsTheCommandAndTheReplyEchoesIt) {
    Bench bench = ping360();
    bench.echo_bin = 900;
    bench.echo_power = 1e15F;  // 150 dB re 1 uPa
    bench.say(transducer(100));
    bench.run_to(5s);
    ASSERT_EQ(bench.shots.size(), 1u);
    const Shot& shot = bench.shots[0];
    EXPECT_NEAR(shot.pan, deg_to_rad(-90), 1e-9) << "200 is ahead";
    EXPECT_EQ(shot.bins, 1200u);
    EXPECT_DOUBLE_EQ(shot.bin_interval, 88 * 25e-9);
    EXPECT_DOUBLE_EQ(shot.frequency, 750e3);
    EXPECT_DOUBLE_EQ(shot.pulse_length, 11e-6);
    EXPECT_NEAR(shot.source_level, 203, 1e-9);
    const Bytes reply = bench.sent().at(0).bytes;
    ASSERT_EQ(reply.size(), 1224u);
    EXPECT_EQ(to_hex(ByteView(reply).first(22)),
              "4252be04fc080200"
              "00006400" +
                  two_metres + "b004");
    EXPECT_EQ(reply[22 + 900], std::lround(255 * (150 - 75.8) / 120)) << "no time-varied gain";
    EXPECT_EQ(reply[22 + 899], 0);
}

TEST(Ping360, AwayFromItsFrequencyItIsWeaker) {
    Bench bench = ping360();
    bench.say(transducer(0, "0b0058008a02b004"));  // 650 kHz
    bench.run_to(0s);
    ASSERT_TRUE(bench.ping);
    EXPECT_NEAR(bench.ping->shot.source_level, 203 - 6, 1e-9);
}

TEST(Ping360, TheMotorTakesTheShortWay) {
    Bench bench = ping360();
    const double window = 1200 * 88 * 25e-9;
    bench.say(transducer(10));
    EXPECT_FALSE(bench.ping) << "it turns first";
    EXPECT_NEAR(to_seconds(bench.wake), 0.060, 1e-9);
    bench.run_to(1s);
    bench.sent();
    bench.say(transducer(390));
    bench.run_to(bench.wake);
    EXPECT_NEAR(to_seconds(bench.now), 1 + 0.120, 1e-6);
    EXPECT_NEAR(to_seconds(bench.ping->due - bench.now), window, 1e-6);
}

TEST(Ping360, AfterMotorOffOrIdleTimeItHomesFirst) {
    Bench bench = ping360();
    bench.say(motor_off);
    EXPECT_THAT(ids(bench.sent()), ElementsAre(1));
    bench.say(transducer(10));
    EXPECT_NEAR(to_seconds(bench.wake), 2.4 + 0.06, 1e-6);
    bench.run_to(3s);
    bench.run_to(40s);
    bench.say(transducer(20));
    EXPECT_NEAR(to_seconds(bench.wake - bench.now), 2.4 + 0.12, 1e-6);
    Bench awake = ping360({{"idle_off", 0.0}});
    awake.run_to(3600s);
    awake.say(transducer(20));
    EXPECT_NEAR(to_seconds(awake.wake - awake.now), 0.12, 1e-6);
}

TEST(Ping360, Angle400IsZeroAndModeZeroIsTaken) {
    Bench bench = ping360();
    bench.say(transducer(400));
    bench.run_to(1s);
    EXPECT_THAT(angles(bench.sent()), ElementsAre(0));
    EXPECT_NEAR(std::abs(bench.shots.at(0).pan), std::numbers::pi, 1e-9);
    Bench echoing = ping360({{"echoed_400", std::string("400")}});
    echoing.say(transducer(400));
    echoing.run_to(1s);
    EXPECT_THAT(angles(echoing.sent()), ElementsAre(400));
}

TEST(Ping360, WithoutTransmissionTheDataIsEmpty) {
    Bench bench = ping360();
    bench.say(transducer(10, two_metres, 0));
    bench.run_to(1s);
    EXPECT_TRUE(bench.shots.empty());
    const auto sent = bench.sent();
    ASSERT_EQ(sent.size(), 1u);
    EXPECT_EQ(sent[0].bytes.size(), 24u);
    bench.say(frame(6, "fc08"));
    EXPECT_EQ(u16(bench.sent().at(0).bytes, 10), 10) << "the state is told on request";
}

TEST(Ping360, CommandsThatComeTogetherAreServedInOrder) {
    Bench bench = ping360();
    Bytes both = transducer(5);
    const Bytes second = transducer(6);
    both.insert(both.end(), second.begin(), second.end());
    bench.say(both);
    bench.run_to(1s);
    EXPECT_THAT(angles(bench.sent()), ElementsAre(5, 6));
}

TEST(Ping360, ValuesOutsideTheRangesAreRefusedUnlessTheOptionTakesThem) {
    for (const char* wrong : {"0000"
                              "5800ee02b004",
                              "e9035800ee02b004", "0b004f00ee02b004", "0b005800f301b004", "0b005800e903b004",
                              "0b005800ee02c700", "0b005800ee02b104"}) {
        Bench bench = ping360();
        bench.say(transducer(0, wrong));
        EXPECT_THAT(ids(bench.sent()), ElementsAre(2)) << wrong;
        Bench lax = ping360({{"invalid_settings", std::string("accept")}});
        lax.say(transducer(0, wrong));
        lax.run_to(3s);
        EXPECT_EQ(to_hex(ByteView(lax.sent().at(0).bytes).subspan(12, 8)), wrong);
    }
    Bench bench = ping360();
    bench.say(transducer(401));
    bench.say(auto_transmit(0, 399, 0));
    bench.say(auto_transmit(0, 399, 1, 101));
    EXPECT_THAT(ids(bench.sent()), ElementsAre(2, 2, 2));
}

TEST(Ping360, AResetIsFollowedBySilenceAndTheSettingsOfPowerUp) {
    Bench bench = ping360();
    bench.say(transducer(10));
    bench.run_to(1s);
    bench.say(frame(2600, "0100"));  // boot loader: 5 s
    bench.sent();
    bench.say(frame(4));
    EXPECT_TRUE(bench.sent().empty());
    bench.run_to(6s);
    bench.say(frame(2300));
    // gain 0, angle 0, 32 us, 80 ticks, 740 kHz, 1024 samples
    EXPECT_EQ(to_hex(ByteView(bench.sent().at(0).bytes).subspan(8, 12)),
              "01000000"
              "20005000e4020004");
}

TEST(Ping360, AnswersWhoAskedAndScansForWhoStarted) {
    const Model& row = *find_model("ping360");
    DeviceConfig config = make_config(row);
    config.endpoints = {parse_endpoint("pty:/tmp/a"), parse_endpoint("udp-listen://127.0.0.1:1234")};
    Bench bench(row.make(config));
    bench.say(auto_transmit(0, 399, 1), 1, {0x7F000001, 5000});
    bench.say(frame(4), 0);
    bench.run_to(50ms);
    const auto sent = bench.sent();
    EXPECT_EQ(sent.at(0).port, 0u);
    EXPECT_EQ(sent.at(1).port, 1u);
    EXPECT_EQ(sent.at(1).to.port, 5000);
    config.options.at("baud") = 115200.0;
    EXPECT_THROW(row.make(config), std::invalid_argument) << "a line rate would cut datagrams";
    config.options.at("baud") = 0.0;
    config.options.at("firmware") = std::string("3.x");
    EXPECT_THROW(row.make(config), std::invalid_argument);
}

}  // namespace
}  // namespace echoloop::test
