// An Imagenex 872 on a bench, driven by the commands of the specification's golden bytes and read by offsets.
#include <gmock/gmock.h>

#include <numbers>

#include "tests/emulator/devices/noisy_line.h"

namespace echoloop::test {
namespace {
using namespace std::chrono_literals;

/// A command: range, frequency, gains of 40 % and 30, packet 0 port or 2 starboard.
std::string command(int packet, int range = 30, int frequency = 2, int gain = 40) {
    char text[64];
    std::snprintf(text, sizeof text, "FE4400%02X000000%02X%02X001E00000000000000%02X00000000000000FD", range,
                  frequency, gain, packet);
    return text;
}
constexpr int port = 0, starboard = 2;

std::vector<Bytes> replies(Bench& bench) {
    std::vector<Bytes> out;
    for (const Send& send : bench.sent()) out.push_back(send.bytes);
    return out;
}

TEST(Imagenex872, TheCommandIsTheSpecifications) {
    EXPECT_EQ(command(port), "FE44001E0000000228001E000000000000000000000000000000FD");
}

TEST(Imagenex872, AnswersPortWhenTheTimeIsOverAndStarboardOfTheSamePingAtOnce) {
    Bench bench(make_device("imagenex-872"));
    bench.say(command(port));
    ASSERT_TRUE(bench.ping);
    EXPECT_EQ(bench.ping->due, 50ms) << "2R/c + 10 ms";
    bench.run_to(49ms);
    EXPECT_TRUE(replies(bench).empty());
    bench.run_to(50ms);
    auto said = replies(bench);
    ASSERT_EQ(said.size(), 1U) << "one write";
    EXPECT_EQ(said[0].size(), 1013U);
    EXPECT_EQ(to_hex(ByteView(said[0]).first(12)),
              "49475810400002"
              "1e00006807");
    EXPECT_EQ(said[0].back(), 0xFC);
    bench.say(command(starboard));
    said = replies(bench);
    ASSERT_EQ(said.size(), 1U);
    EXPECT_FALSE(bench.ping);
    EXPECT_EQ(to_hex(ByteView(said[0]).first(12)),
              "49475810400001"
              "1e00006807");
}

TEST(Imagenex872, StarboardAlonePingsItselfOrIsRefused) {
    Bench bench(make_device("imagenex-872"));
    bench.say(command(starboard));
    bench.run_to(1s);
    EXPECT_EQ(replies(bench).size(), 1U);
    bench.say(command(starboard));
    EXPECT_TRUE(bench.ping) << "each ping has one starboard";
    Bench refusing(make_device("imagenex-872", {}, {{"starboard_alone", std::string("refuse")}}));
    refusing.say(command(starboard));
    EXPECT_FALSE(refusing.ping);
    EXPECT_EQ(refusing.device().counters().rejected, 1U);
}

TEST(Imagenex872, BothCommandsBeforeTheEchoAreBothAnswered) {
    Bench bench(make_device("imagenex-872"));
    bench.say(command(port) + command(starboard));
    bench.run_to(1s);
    const auto said = replies(bench);
    ASSERT_EQ(said.size(), 2U);
    EXPECT_EQ(said[0][6], 2);
    EXPECT_EQ(said[1][6], 1);
    EXPECT_EQ(bench.shots.size(), 1U);
}

/// The sample of an echo in bin 300 of `beam`, as the side's reply has it.
int sample(std::size_t beam, int side, float power, int gain = 40, const Options& changes = {}) {
    Bench bench(make_device("imagenex-872", {}, changes));
    bench.say(command(port, 30, 2, gain) + command(starboard, 30, 2, gain));
    Echogram echogram = echo_of(bench.ping->shot, 0, 0);
    echogram.values.at(beam * echogram.shot.bins + 300) = power;
    bench.hear(echogram);
    return replies(bench).at(side == port ? 0 : 1).at(12 + 300);
}

TEST(Imagenex872, PortIsNotStarboard) {
    EXPECT_GT(sample(0, port, 1e12F), 0);
    EXPECT_EQ(sample(0, starboard, 1e12F), 0);
    EXPECT_EQ(sample(1, port, 1e12F), 0);
    EXPECT_GT(sample(1, starboard, 1e12F), 0);
}

TEST(Imagenex872, LevelsFollowTheSonarEquationAndTheGain) {
    EXPECT_NEAR(sample(0, port, 1e12F) - sample(0, port, 1e11F), 255 * 10 / 60.0, 1);
    EXPECT_NEAR(sample(0, port, 1e12F, 50) - sample(0, port, 1e12F, 40), 255 * 6 / 60.0, 1);
    EXPECT_EQ(sample(0, port, 1e30F), 255);
    EXPECT_EQ(sample(0, port, 1e30F, 40, {{"ceiling", std::string("127")}}), 127);
}

TEST(Imagenex872, RangesAndFrequenciesAreThoseThatItHas) {
    Bench bench(make_device("imagenex-872"));
    const auto ping = [&](int range, int frequency) {
        bench.say(command(port, range, frequency));
        EXPECT_TRUE(bench.ping);
        const Shot shot = bench.ping->shot;
        bench.hear();
        return shot;
    };
    const auto range = [](const Shot& shot) {
        return 750 * shot.bin_interval * static_cast<double>(shot.bins);
    };
    EXPECT_NEAR(range(ping(30, 2)), 30, 1e-9);
    EXPECT_NEAR(range(ping(70, 0)), 60, 1e-9);
    EXPECT_NEAR(range(ping(200, 0)), 200, 1e-9);
    EXPECT_NEAR(range(ping(200, 2)), 50, 1e-9) << "of the high frequency";
    EXPECT_NEAR(range(ping(0, 1)), 10, 1e-9);
    EXPECT_EQ(ping(30, 0).frequency, 260e3);
    EXPECT_EQ(ping(30, 1).frequency, 330e3);
    const Shot high = ping(30, 2);
    EXPECT_EQ(high.frequency, 800e3);
    EXPECT_THAT(high.bearings, testing::ElementsAre(-std::numbers::pi / 2, std::numbers::pi / 2));
    ASSERT_EQ(high.sides.size(), 2U);
    EXPECT_NEAR(high.sides[0].depression, deg_to_rad(20), 1e-9);
}

TEST(Imagenex872, ANewHostFindsNothingOfTheOldOne) {
    Bench bench(make_device("imagenex-872"));
    bench.say(command(port));
    bench.device().reconnected(0);
    bench.run_to(1s);
    EXPECT_TRUE(replies(bench).empty());
    bench.say(command(port));
    bench.run_to(2s);
    EXPECT_EQ(replies(bench).size(), 1U);
}

TEST(Imagenex872, NoNoiseOnTheLineWedgesIt) {
    Bench bench(make_device("imagenex-872"));
    NoisyHost host;
    host.words = {command(port), command(starboard), command(port, 200, 0), command(1)};
    host.quiet = 1s;
    // The first completes half a command that may wait.
    host.request = std::string(54, '0') + command(port, 50);
    host.is_answer = [](const Send& send) { return send.bytes.size() == 1013; };
    host.patience = 2s;
    expect_no_wedge(bench, host, 300);
}

}  // namespace
}  // namespace echoloop::test
