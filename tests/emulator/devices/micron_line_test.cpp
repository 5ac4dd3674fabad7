// The lines of a Micron: what the commands make of the ping, the reply and the scan, and what noise does not.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "tests/emulator/devices/micron_bench.h"

namespace echoloop::test {
namespace {

using testing::ElementsAre;

TEST(MicronLine, PingFollowsTheParameters) {
    Bench bench = scanning(continuous);
    bench.say(send_data);
    ASSERT_TRUE(bench.ping);
    const Shot& shot = bench.ping->shot;
    EXPECT_EQ(shot.bins, 200u);
    EXPECT_DOUBLE_EQ(shot.bin_interval, 104 * 640e-9);
    EXPECT_NEAR(shot.beam_width, deg_to_rad(3), 1e-12);
    EXPECT_NEAR(shot.fan_height, deg_to_rad(35), 1e-12);
    // 2R/c = 200 * 104 * 640 ns = 13.312 ms, motor 31 * 250 us = 7.75 ms
    EXPECT_NEAR(to_seconds(bench.ping->due - bench.now), 0.021062, 1e-6);
}

TEST(MicronLine, ReplyEchoesTheCommandAndCarriesTheLevels) {
    Bench bench = scanning(continuous);
    bench.echo_bin = 120;
    bench.echo_power = 1e13F;  // 130 dB re 1 uPa
    bench.say(send_data);
    bench.hear();
    const auto found = lines(bench.sent());
    ASSERT_EQ(found.size(), 1u);
    const Bytes& line = found[0];
    ASSERT_EQ(line.size(), 245u);
    EXPECT_EQ(to_hex(ByteView(line).first(20)), "4030304546ef0002ff00028002e7001110008323");
    EXPECT_EQ(line[9], 0) << "byte 9";
    EXPECT_EQ(u16(line, 13), 200 + 31);
    EXPECT_EQ(line[15], 0x11);
    EXPECT_EQ(line[16], 0x10) << "8-bit data";
    EXPECT_EQ(u16(line, 18), 0x2383);
    EXPECT_EQ(u16(line, 20), 100) << "RangeScale echo";
    EXPECT_EQ(line[26], 0x54) << "gain";
    EXPECT_EQ(line[29], 0x51) << "ADSpan";
    EXPECT_EQ(line[30], 0x08) << "ADLow";
    EXPECT_EQ(u16(line, 33), 104);
    EXPECT_EQ(line[39], 31);
    EXPECT_EQ(u16(line, 40), 3200);
    EXPECT_EQ(u16(line, 42), 200);
    // R = 120.5 * 104 * 640 ns * 1500 / 2 = 6.015 m; 130 + 30 log R + 80 * 84/210 - 146.2 = 39.18 dB of 80
    EXPECT_EQ(line[44 + 120], 255 * 78 / 160) << "in half decibels";
    EXPECT_EQ(line[44 + 119], 0);
    EXPECT_EQ(line.back(), 0x0A);
}

/// In four recordings of two heads all values are floor(255 k / 160), and the first two bins are 0 (where a
/// bin is long, the first hears what breaks through). Over the next three the receiver opens.
TEST(MicronLine, LevelsComeInHalfDecibelsBehindTwoSilentBins) {
    for (const std::string model : {"tritech-micron", "tritech-seaking"}) {
        Bench bench = scanning(continuous, {}, model);
        bench.say(send_data);
        Echogram ramp = echo_of(bench.ping->shot, 0, 0);
        for (std::size_t bin = 0; bin < ramp.values.size(); ++bin)
            ramp.values[bin] = std::pow(10.0F, 0.4F * 0.1F * static_cast<float>(bin) + 14.5F);
        bench.hear(ramp);
        const Bytes line = lines(bench.sent()).at(0);
        std::set<int> allowed, seen;
        for (int k = 0; k <= 160; ++k) allowed.insert(255 * k / 160);
        for (std::size_t bin = 0; bin < 200; ++bin) {
            seen.insert(line[44 + bin]);
            EXPECT_TRUE(allowed.contains(line[44 + bin])) << int{line[44 + bin]};
        }
        EXPECT_EQ(line[44] + line[45], 0);
        EXPECT_LT(line[46], line[48]);
        EXPECT_GT(line[48], 0);
        EXPECT_EQ(*seen.rbegin(), 255);
        EXPECT_GT(seen.size(), 60U);
    }
}

TEST(MicronLine, TwoLinesPerRequestAndNoMore) {
    Bench bench = scanning(clockwise);
    bench.say(send_data);
    bench.run_to(bench.now + 900ms);
    EXPECT_THAT(bearings(bench.sent()), ElementsAre(3200, 3232));
    bench.say(send_data);
    bench.run_to(bench.now + 900ms);
    EXPECT_THAT(bearings(bench.sent()), ElementsAre(3264, 3296));
}

TEST(MicronLine, SecondLineWaitsForTheSerialPort) {
    Bench bench = scanning(clockwise);
    bench.say(send_data);
    const Time first = bench.ping->due;
    bench.hear();
    EXPECT_FALSE(bench.ping);
    // 445 bytes at 115200 8N1
    EXPECT_NEAR(to_seconds(bench.wake - first), 445 * 10 / 115200.0, 1e-6);
}

TEST(MicronLine, SurplusRequestsMergeOrQueue) {
    Bench merging = scanning(clockwise);
    for (int i = 0; i < 5; ++i) merging.say(send_data);
    merging.run_to(merging.now + 5s);
    EXPECT_EQ(lines(merging.sent()).size(), 4u) << "one pair at hand, one pending";

    Bench queueing =
        scanning(clockwise, {{"surplus_requests", std::string("queue")}, {"replies", std::int64_t{1}}});
    for (int i = 0; i < 5; ++i) queueing.say(send_data);
    queueing.run_to(queueing.now + 5s);
    EXPECT_EQ(lines(queueing.sent()).size(), 5u);
}

TEST(MicronLine, RequestsBeforeTheHeadIsReadyAreIgnored) {
    Bench bench = powered_up();
    bench.run_to(4s);
    bench.say(send_data);
    EXPECT_FALSE(bench.ping);
    Bench centring = powered_up();
    centring.run_to(1s);
    centring.say(clockwise);
    centring.say(send_data);
    centring.sent();
    centring.run_to(8s);
    EXPECT_TRUE(lines(centring.sent()).empty());
    Bench later = powered_up({{"early_request", std::string("answer-later")}});
    later.run_to(1s);
    later.say(clockwise);
    later.say(send_data);
    later.run_to(8s);
    EXPECT_EQ(lines(later.sent()).size(), 2u);
}

TEST(MicronLine, AlivesPauseWhileLinesAreServed) {
    Bench bench = scanning(clockwise);
    for (int i = 0; i < 40; ++i) {
        bench.say(send_data);
        bench.run_to(bench.now + 150ms);
    }
    EXPECT_TRUE(alives(bench.sent()).empty());
    bench.run_to(bench.now + 1500ms);
    EXPECT_EQ(alives(bench.sent()).size(), 1u);
}

TEST(MicronLine, FourBitBinsArePackedHighHalfFirst) {
    Bench bench = scanning(four_bit);
    bench.echo_bin = 120;
    bench.echo_power = 1e30F;
    bench.say(send_data);
    bench.hear();
    const auto found = lines(bench.sent());
    ASSERT_EQ(found[0].size(), 145u);
    EXPECT_EQ(u16(found[0], 42), 100);
    EXPECT_EQ(found[0][16], 0);
    EXPECT_EQ(found[0][44 + 60], 0xF0);
    Bench low = scanning(four_bit, {{"nibble_order", std::string("low-first")}});
    low.echo_bin = 120;
    low.echo_power = 1e30F;
    low.say(send_data);
    low.hear();
    EXPECT_EQ(lines(low.sent())[0][44 + 60], 0x0F);
}

TEST(MicronLine, NewParametersEndTheLineUnderWay) {
    Bench bench = scanning(clockwise);
    bench.say(send_data);
    bench.say(continuous);
    bench.sent();
    bench.run_to(bench.now + 900ms);
    EXPECT_TRUE(lines(bench.sent()).empty()) << "a driver would reject a line with the old settings";
}

TEST(MicronLine, GainBlockCountsFromTheNextLineOn) {
    Bench bench = scanning(clockwise);
    bench.say(gain_block);
    bench.say(send_data);
    bench.hear();
    const Bytes line = lines(bench.sent()).at(0);
    EXPECT_EQ(line[29], 0x5F);
    EXPECT_EQ(line[30], 0x1F);
    EXPECT_EQ(line[26], 0x69);
}

TEST(MicronScan, AnticlockwiseWithoutScanright) {
    Bench bench = scanning(continuous);
    bench.say(send_data);
    bench.run_to(bench.now + 500ms);
    EXPECT_THAT(bearings(bench.sent()), ElementsAre(3200, 3169));
    EXPECT_NEAR(bench.shots[0].pan, 0, 1e-12);
    EXPECT_NEAR(bench.shots[1].pan, -31 * deg_to_rad(0.05625), 1e-9) << "to port";
}

TEST(MicronScan, ReverseTurnsAtOnceAndShowsInHdCtrl) {
    Bench bench = scanning(clockwise);
    bench.say(send_data);
    bench.run_to(bench.now + 500ms);
    bench.say(reverse);
    bench.say(send_data);
    bench.run_to(bench.now + 500ms);
    const auto sent = bench.sent();
    EXPECT_THAT(bearings(sent), ElementsAre(3200, 3232, 3264, 3232));
    EXPECT_EQ(u16(lines(sent)[0], 18), 0x2307);
    EXPECT_EQ(u16(lines(sent)[2], 18), 0x2303);
}

TEST(MicronScan, SectorStartsLeftPingsEachLimitOnceAndCutsTheLastStep) {
    Bench bench = scanning(sector);
    for (int i = 0; i < 55; ++i) {
        bench.say(send_data);
        bench.run_to(bench.now + 200ms);
    }
    const auto found = lines(bench.sent());
    ASSERT_EQ(found.size(), 110u);
    EXPECT_EQ(u16(found[0], 40), 2399);
    EXPECT_EQ(found[0][17], 1) << "sweep code at the left limit";
    EXPECT_EQ(u16(found[51], 40), 2399 + 51 * 31);
    EXPECT_EQ(u16(found[52], 40), 3999) << "1600 is no multiple of 31";
    EXPECT_EQ(found[52][17], 2) << "sweep code at the right limit";
    EXPECT_EQ(u16(found[53], 40), 3968);
    EXPECT_EQ(found[53][17], 0);
    EXPECT_EQ(u16(found[104], 40), 2399);
    EXPECT_EQ(u16(found[105], 40), 2430);
    EXPECT_EQ(u16(found[0], 35), 2399) << "limits are echoed raw";
    EXPECT_EQ(u16(found[0], 37), 3999);
}

TEST(MicronNoise, GarbageTruncationAndOthersCommandsAreNotAnswered) {
    Bench bench = scanning(clockwise);
    bench.say("ffffffff40404030303030");
    bench.say(profiler_command);
    bench.say("403030304104000002000a0a");
    std::string cut = clockwise.substr(0, clockwise.size() - 20);
    bench.say(cut);
    EXPECT_TRUE(bench.sent().empty());
    EXPECT_FALSE(bench.ping);
    EXPECT_GT(bench.device().counters().rejected, 0u);
    bench.device().reconnected(0);  // the driver died in mid-frame; the next one finds a clean line
    bench.say(send_version);
    EXPECT_EQ(bench.sent().size(), 1u);
    EXPECT_GT(bench.device().counters().skipped_bytes, 0u);
}

TEST(MicronNoise, UnusableParametersAreDropped) {
    Bench bench = powered_up();
    bench.run_to(4s);
    bench.sent();
    std::string no_bins = clockwise;
    no_bins.replace(2 * 53, 4, "0000");
    bench.say(no_bins);
    EXPECT_TRUE(bench.sent().empty());
    std::string all_ones = clockwise;
    all_ones.replace(2 * 14, 2 * 51, std::string(2 * 51, 'f'));
    bench.say(all_ones);
    bench.say(send_data);
    ASSERT_TRUE(bench.ping) << "the largest values of every field still make a ping";
    EXPECT_EQ(bench.ping->shot.bins, 1500u);
    EXPECT_LE(static_cast<double>(bench.ping->shot.bins) * bench.ping->shot.bin_interval, 10.0 + 1e-9);
}

}  // namespace
}  // namespace echoloop::test
