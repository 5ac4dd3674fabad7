// The profiler, node 20: passes, echo times and gain, by literal bytes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/emulator/devices/micron_bench.h"

namespace echoloop::test {
namespace {

using testing::Each;
using testing::ElementsAre;

const std::string profiler_send_data = "40303030430c00ff1407198014000000000a";
// A public driver's own command, see micron_bench.h: +-45 deg, step 88, 15 m, alternating, first echo,
// channel 2, threshold 50, AGCmax 107, slope 150, ScanTime 203, lockout 1356 us. 1600 / 88: 20 pings.
const std::string& command = profiler_command;
const std::string strongest = changed(changed(command, 14, "8222"), 55, "0100");
const std::string one_ping = changed(command, 15, "33");  // stare at the left limit

Bench profiling(const std::string& with, const Options& changes = {}) {
    return scanning(with, changes, "tritech-profiler");
}

std::vector<int> times(const Bytes& reply) {
    std::vector<int> found;
    for (int i = 0; i < u16(reply, 38); ++i)
        found.push_back(u16(reply, 40 + 2 * static_cast<std::size_t>(i)));
    return found;
}

std::vector<Bytes> passes(Bench& bench, int count) {
    for (int i = 0; i < count; ++i) {
        bench.say(profiler_send_data);
        bench.run_to(bench.now + 900ms);
    }
    return lines(bench.sent());
}

TEST(Profiler, AlivesAndVersionComeFromNode20) {
    Bench bench = powered_up({}, "tritech-profiler");
    bench.run_to(1s);
    EXPECT_EQ(to_hex(bench.sent().at(0).bytes), "4030303130100014ff0b04801480e8030000800c5d0a");
    bench.say(send_version);
    EXPECT_TRUE(bench.sent().empty()) << "node 2 is another head";
}

TEST(Profiler, ReplyIsAPassWithOneTimePerPing) {
    Bench bench = profiling(command);
    bench.echo_bin = 2000;
    bench.echo_power = 1e15F;
    const auto found = passes(bench, 1);
    ASSERT_EQ(found.size(), 1u);
    const Bytes& reply = found[0];
    const int count = 20;  // 2399, 2487 .. 3983, 3999
    ASSERT_EQ(reply.size(), 2u * count + 51);
    EXPECT_EQ(to_hex(ByteView(reply).first(13)), "4030303535550014ff00028014");
    EXPECT_EQ(u16(reply, 13), 2 * count + 37);
    EXPECT_EQ(reply[15], 5) << "HdType";
    EXPECT_EQ(u16(reply, 18), 0x2386) << "clockwise, from the left limit";
    EXPECT_EQ(u16(reply, 20), 150);
    EXPECT_EQ(to_hex(ByteView(reply).subspan(22, 4)), "99999909");
    EXPECT_EQ(reply[26], 107);
    EXPECT_EQ(u16(reply, 27), 150);
    EXPECT_EQ(reply[29], 50);
    EXPECT_EQ(reply[30], 20);
    EXPECT_EQ(u16(reply, 31), 2399);
    EXPECT_EQ(u16(reply, 33), 3999);
    EXPECT_EQ(reply[35], 88);
    EXPECT_EQ(u16(reply, 36), 203);
    // 20.3 ms in bins of 5 us
    EXPECT_THAT(times(reply), Each(10000));
    ASSERT_EQ(bench.shots.size(), 20u);
    EXPECT_NEAR(bench.shots[0].pan, (2399 - 3200) * deg_to_rad(0.05625), 1e-9);
    EXPECT_NEAR(bench.shots[19].pan, (3999 - 3200) * deg_to_rad(0.05625), 1e-9);
    EXPECT_NEAR(bench.shots[0].frequency, 1.2e6, 100);
}

TEST(Profiler, PassesAlternateOrRunOneWay) {
    Bench bench = profiling(command);
    const auto found = passes(bench, 2);
    ASSERT_EQ(found.size(), 2u);
    EXPECT_EQ(u16(found[1], 18) & 4, 0) << "back to the left";
    EXPECT_EQ(found[0][17], 2);
    EXPECT_EQ(found[1][17], 1);
    EXPECT_NEAR(bench.shots[20].pan, (3999 - 3200) * deg_to_rad(0.05625), 1e-9);
    EXPECT_NEAR(bench.shots[39].pan, (2399 - 3200) * deg_to_rad(0.05625), 1e-9);
    Bench one_way = profiling(changed(command, 14, "80"));
    passes(one_way, 2);
    EXPECT_NEAR(one_way.shots[0].pan, one_way.shots[20].pan, 1e-9);
    EXPECT_NEAR(one_way.shots[0].pan, (3999 - 3200) * deg_to_rad(0.05625), 1e-9) << "anticlockwise";
}

TEST(Profiler, AFullCircleDoesNotPingItsEndTwice) {
    Bench bench = profiling(changed(changed(changed(command, 37, "0000"), 39, "0000"), 50, "20"));
    bench.say(profiler_send_data);
    bench.run_to(bench.now + 10s);
    const auto found = lines(bench.sent());
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(u16(found[0], 38), 200);
}

TEST(Profiler, TimeOfAPassIsWindowAndMotor) {
    Bench bench = profiling(command);
    bench.say(profiler_send_data);
    const Time start = bench.now;
    EXPECT_NEAR(to_seconds(bench.ping->due - start), 0.0203, 1e-6) << "the head stands at the limit";
    bench.hear();
    EXPECT_NEAR(to_seconds(bench.ping->due - bench.now), 0.0203 + 88 * 250e-6, 1e-6);
    bench.run_to(start + 2s);
    EXPECT_EQ(lines(bench.sent()).size(), 1u);
}

TEST(Profiler, NoAliveComesWhileAPassIsUnderWay) {
    Bench bench = profiling(changed(command, 50, "08"));  // 201 pings of 22.3 ms
    bench.say(profiler_send_data);
    bench.run_to(bench.now + 4400ms);
    EXPECT_TRUE(bench.sent().empty());
    bench.run_to(bench.now + 1500ms);
    const auto sent = bench.sent();
    EXPECT_EQ(lines(sent).size(), 1u);
    EXPECT_EQ(alives(sent).size(), 1u);
}

/// Echoes of two strengths in one ping.
std::vector<int> times_of_two_echoes(const std::string& mode) {
    Bench bench = profiling(mode);
    bench.say(profiler_send_data);
    Echogram echogram = echo_of(bench.ping->shot, 1000, 1e13F);  // 5.0 ms
    for (std::size_t bin : {2997u, 2998u, 2999u}) echogram.values[bin] = 3e14F;
    echogram.values[3000] = 1e15F;  // 15.0 ms
    const Actions actions = bench.device().heard(echogram, bench.ping->due);
    std::vector<int> found;
    for (const Send& send : actions.send) found.push_back(u16(send.bytes, 40));
    return found;
}

TEST(Profiler, FirstStrongestOrEdge) {
    // One ping a pass: the step is as wide as the sector.
    const auto narrow = [](const std::string& mode) { return changed(changed(mode, 39, "5f09"), 50, "00"); };
    EXPECT_THAT(times_of_two_echoes(narrow(changed(command, 14, "8223"))), ElementsAre(5000));
    EXPECT_THAT(times_of_two_echoes(narrow(changed(changed(command, 14, "8222"), 55, "0100"))),
                ElementsAre(15003));
    EXPECT_THAT(times_of_two_echoes(narrow(changed(command, 14, "8222"))), ElementsAre(14985));
}

TEST(Profiler, WeakAndEarlyEchoesDoNotCount) {
    Bench silent = profiling(command);
    EXPECT_THAT(times(passes(silent, 1).at(0)), Each(0));
    Bench early = profiling(command);
    early.echo_bin = 200;  // 1.0 ms, the lockout is 1.356 ms
    early.echo_power = 1e15F;
    EXPECT_THAT(times(passes(early, 1).at(0)), Each(0));
    Bench deaf = profiling(changed(command, 41, "ff"));
    deaf.echo_bin = 2000;
    deaf.echo_power = 1e15F;  // 150 + 30 log 7.5 + .. + 33.6 - 163 dB, below 80 dB
    EXPECT_THAT(times(passes(deaf, 1).at(0)), Each(0));
}

TEST(Profiler, AdaptiveGainBringsTheEchoToTheSetPoint) {
    Bench bench = profiling(changed(changed(command, 14, "83"), 43, "ff"));  // AGCmax 80 dB, set point 100
    bench.echo_bin = 2000;
    bench.echo_power = 1e15F;
    const auto found = passes(bench, 3);
    ASSERT_EQ(found.size(), 3u);
    // level 150 + 30 log10 7.502 + 2 * 0.495 * 7.502 - 163 = 20.7 dB; the set point is 31.4 dB
    EXPECT_NEAR(found[2][26] * 80 / 255.0, 31.4 - 20.7, 1.0);
}

TEST(Profiler, GainBlockCountsFromTheNextPassOn) {
    Bench bench = profiling(command);
    bench.say(changed(changed(gain_block, 8, "14"), 12, "14"));
    const Bytes reply = passes(bench, 1).at(0);
    EXPECT_EQ(reply[29], 0x5F) << "threshold of channel 2";
    EXPECT_EQ(reply[30], 0x1F) << "FiltGain";
    EXPECT_EQ(reply[26], 0x69) << "AGCmax";
}

TEST(Profiler, AcquisitionBlockOfTheLongCommandByOption) {
    const std::string other = changed(command, 66, "64");  // threshold of channel 2
    Bench main = profiling(other);
    EXPECT_EQ(passes(main, 1).at(0)[29], 50);
    Bench block = profiling(other, {{"acquisition", std::string("block")}});
    EXPECT_EQ(passes(block, 1).at(0)[29], 100);
}

TEST(Profiler, UnusableCommandsAreDroppedAndExtremesSurvive) {
    Bench bench = powered_up({}, "tritech-profiler");
    bench.run_to(4s);
    bench.sent();
    bench.say(changed(command, 51, "0000"));
    EXPECT_TRUE(bench.sent().empty()) << "no ScanTime";
    bench.say(changed(command, 14, std::string(2 * 51, 'f')));
    bench.say(profiler_send_data);
    ASSERT_TRUE(bench.ping);
    EXPECT_LE(bench.ping->shot.bins, 5000u);
    bench.say(changed(changed(command, 37, "0000ff18"), 50, "01"));  // 0 to 6399 by one unit
    bench.say(profiler_send_data);
    bench.run_to(bench.now + 120s);
    const auto found = lines(bench.sent());
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].size(), 2022u * 2 + 51) << "a frame of 4096 bytes at most";
}

}  // namespace
}  // namespace echoloop::test
