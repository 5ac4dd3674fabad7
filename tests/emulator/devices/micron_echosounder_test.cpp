// The Micron Echosounder on a bench: literal lines at given times, echoes made up by the test. Depths follow
// from bins of 50 m / 8334.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/emulator/devices/driver.h"

namespace echoloop::test {
namespace {
using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::IsEmpty;

Bench altimeter(const Options& changes = {}, std::vector<std::string> endpoints = {}) {
    Bench bench(make_device("micron-echosounder", std::move(endpoints), changes));
    bench.echo_bin = 1333;  // 1333 x 50 m / 8334 = 7.997 m
    bench.echo_power = 1e13F;
    return bench;
}

Options with(const std::string& option, const std::string& word) { return {{option, word}}; }

std::vector<std::string> lines(Bench& bench) {
    std::vector<std::string> all;
    for (const Send& s : bench.sent()) all.emplace_back(s.bytes.begin(), s.bytes.end());
    return all;
}

TEST(TritechEchosounder, SaysTenBytesFourTimesASecond) {
    Bench bench = altimeter();
    bench.run_to(86ms);  // 2 x 50 m / 1500 m/s + 20 ms = 86.7 ms
    EXPECT_THAT(lines(bench), IsEmpty());
    bench.run_to(87ms);
    EXPECT_THAT(lines(bench), ElementsAre("007.997m\r\n"));
    bench.run_to(10100ms);
    EXPECT_EQ(lines(bench).size(), 40u);
}

TEST(TritechEchosounder, HasTheFormatsOfItsHosts) {
    const auto first = [](const std::string& format) {
        Bench bench = altimeter(with("format", format));
        bench.run_to(100ms);
        return lines(bench);
    };
    EXPECT_THAT(first("3P2"), ElementsAre("008.00m\r\n"));
    EXPECT_THAT(first("mm"), ElementsAre("7997mm\n"));
    // 7.9974 m / 0.3048 = 26.238 ft, / 6 = 4.373 fathoms; the checksum is another program's.
    EXPECT_THAT(first("nmea"), ElementsAre("$PADBT,026.24,f,008.00,M,004.37,F*3A\r\n"));
}

TEST(TritechEchosounder, WithoutAnEchoFailsLowOrHighOrIsSilent) {
    const auto said = [](Options changes) {
        Bench bench = altimeter(changes);
        bench.echo_power = 0;
        bench.run_to(100ms);
        return lines(bench);
    };
    EXPECT_THAT(said({}), ElementsAre("000.000m\r\n"));
    EXPECT_THAT(said(with("no_bottom", "maximum")), ElementsAre("050.000m\r\n"));
    EXPECT_THAT(said(with("no_bottom", "silent")), IsEmpty());
    EXPECT_THAT(said({{"format", std::string("mm")}}), ElementsAre("0mm\n"));
}

TEST(TritechEchosounder, SeesNothingInItsBlanking) {
    Bench bench = altimeter();
    bench.echo_bin = 47;  // 0.282 m
    bench.run_to(100ms);
    EXPECT_THAT(lines(bench), ElementsAre("000.000m\r\n"));
}

TEST(TritechEchosounder, InterrogatedSaysOneReadingForEachZ) {
    Bench bench = altimeter(with("mode", "interrogated"));
    bench.run_to(1s);
    EXPECT_THAT(lines(bench), IsEmpty());
    EXPECT_TRUE(bench.shots.empty()) << "no ping that nobody asked for";
    bench.say("5a");
    bench.run_to(1086ms);
    EXPECT_THAT(lines(bench), IsEmpty());
    bench.run_to(3s);
    EXPECT_THAT(lines(bench), ElementsAre("007.997m\r\n"));
    bench.say("5a5a5a");
    bench.run_to(3050ms);
    bench.say("5a");
    bench.run_to(3090ms);
    EXPECT_EQ(lines(bench).size(), 1u) << "a ping under way answers them all, and in its time";
    bench.run_to(4s);
    EXPECT_THAT(lines(bench), IsEmpty());
}

TEST(TritechEchosounder, ZStopsItAndFStartsItAgain) {
    Bench bench = altimeter();
    bench.run_to(1s);
    bench.say("5a");
    bench.run_to(5s);
    bench.sent();
    bench.run_to(10s);
    EXPECT_THAT(lines(bench), IsEmpty());
    bench.say("46");
    bench.run_to(20s);
    EXPECT_NEAR(static_cast<double>(lines(bench).size()), 40, 1);
    bench.say("465a46");
    bench.run_to(30s);
    EXPECT_NEAR(static_cast<double>(lines(bench).size()), 40, 1);
    bench.say("465a");
    bench.run_to(31s);
    bench.sent();
    bench.run_to(40s);
    EXPECT_THAT(lines(bench), IsEmpty());
}

TEST(TritechEchosounder, CountsWhatItDoesNotKnow) {
    Bench bench = altimeter();
    bench.say("00ff7a665a");
    EXPECT_EQ(bench.device().counters().skipped_bytes, 4u);
    EXPECT_EQ(bench.device().counters().messages, 1u);
}

TEST(TritechEchosounder, IsNeverAheadOfItsLine) {
    Bench bench = altimeter({{"rate", 20.0}, {"range", 5.0}, {"baud", 1200.0}});  // 83.3 ms for ten bytes
    bench.run_to(10s);
    EXPECT_NEAR(static_cast<double>(lines(bench).size()), 10 / 0.1, 12);
    EXPECT_LE(bench.shots.size(), 121u);
}

TEST(TritechEchosounder, OnANoisyLineAnswersTheNextGoodZ) {
    Bench bench = altimeter(with("mode", "interrogated"));
    for (int i = 0; i < 256; ++i) {
        const auto noise = static_cast<std::uint8_t>(i);
        bench.say(Bytes{noise, static_cast<std::uint8_t>(noise ^ 0x11)});
        bench.run_to(bench.now + 1s);
        bench.sent();
        bench.say("5a");
        bench.run_to(bench.now + 100ms);
        ASSERT_GE(lines(bench).size(), 1u) << i;
        bench.say("5a");
        bench.run_to(bench.now + 1s);
        ASSERT_EQ(lines(bench).size(), 1u) << i;
    }
}

TEST(TritechEchosounder, SendsDatagramsToItsHost) {
    Bench bench = altimeter({}, {"udp://127.0.0.1:4001"});
    bench.run_to(100ms);
    const auto sent = bench.sent();
    ASSERT_EQ(sent.size(), 1u);
    EXPECT_EQ(sent[0].to, (Address{0x7F000001, 4001}));
    EXPECT_THROW(altimeter({}, {"udp-listen://127.0.0.1:4001"}), std::invalid_argument);
    EXPECT_THROW(altimeter({}, {"pty:/tmp/a", "pty:/tmp/b"}), std::invalid_argument);
}

}  // namespace
}  // namespace echoloop::test
