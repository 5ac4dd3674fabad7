// The navigation unit on a bench: literal moments, words read by the offsets of their makers' manuals.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/emulator/devices/driver.h"

namespace echoloop::test {
namespace {
using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::HasSubstr;

const std::vector<std::string> one_line{"pty:/tmp/echoloop-ins"};

/// A unit that says `words` on one line, from 22:13:20 of 14 Nov 2023 on.
Bench unit(const std::string& words, Options changes = {}, std::vector<std::string> endpoints = one_line) {
    DeviceConfig config = make_config(*find_model("nmea-ins"), changes);
    config.options.at("ports") = words;
    config.endpoints = parse_endpoints(endpoints);
    config.unix_start = 1700000000;
    config.origin = GeoPlace{59.4, 10.5, 40};
    return Bench(find_model("nmea-ins")->make(config));
}

/// Heading in deg from north, roll with port up, pitch with the bow up.
Pose vessel(double roll, double pitch, double heading, Vec3 position = {}) {
    const double half_yaw = deg_to_rad(90 - heading) / 2, half_pitch = deg_to_rad(-pitch) / 2,
                 half_roll = deg_to_rad(roll) / 2;
    const Quat yaw{std::cos(half_yaw), 0, 0, std::sin(half_yaw)},
        nose{std::cos(half_pitch), 0, std::sin(half_pitch), 0},
        lean{std::cos(half_roll), std::sin(half_roll), 0, 0};
    return {position, yaw * nose * lean};
}

std::vector<std::string> lines(Bench& bench) {
    std::vector<std::string> all;
    for (const Send& s : bench.sent()) all.emplace_back(s.bytes.begin(), s.bytes.end());
    return all;
}

TEST(NmeaIns, SaysWhereItIsAndHowItLies) {
    Bench bench = unit("GGA ZDA VTG HDT PASHR");
    bench.where = [](Time time) {
        Located where{time, vessel(2.5, -1.25, 30.4, {0, 0, -2.5}), {}};
        where.motion.velocity = {1.8, 2.4, 0};
        return where;
    };
    bench.run_to(6ms);
    // Checksums were worked out by another program; 3 m/s are 5.832 kn and 10.8 km/h.
    EXPECT_THAT(
        lines(bench),
        ElementsAre(
            "$INGGA,221320.00,5924.0000000,N,01030.0000000,E,4,12,0.8,37.500,M,0.000,M,1.0,0001*55\r\n",
            "$INZDA,221320.00,14,11,2023,00,00*70\r\n", "$INVTG,36.87,T,,M,5.832,N,10.800,K,D*27\r\n",
            "$INHDT,30.40,T*22\r\n",
            "$PASHR,221320.000,30.40,T,+2.50,-1.25,+0.00,0.011,0.011,0.022,2,1*08\r\n"));
}

TEST(NmeaIns, SpeaksOfWholePartsOfTheSecondWheneverTheRunBegan) {
    DeviceConfig config = make_config(*find_model("nmea-ins"), {{"ports", std::string("ZDA HDT")}});
    config.endpoints = parse_endpoints(one_line);
    config.unix_start = 1700000000.375;
    Bench bench(find_model("nmea-ins")->make(config));
    std::vector<Time> asked;
    bench.where = [&](Time time) {
        asked.push_back(time);
        return Located{time, {}, {}};
    };
    bench.run_to(629ms);
    for (const std::string& line : lines(bench)) EXPECT_THAT(line, HasSubstr("HDT")) << "no second has begun";
    bench.run_to(1631ms);
    const auto said = lines(bench);
    ASSERT_EQ(said.size(), 2u + 11) << "two edges, headings from the one to the other";
    EXPECT_EQ(said[0], "$INZDA,221321.00,14,11,2023,00,00*71\r\n");
    EXPECT_EQ(said[1], "$INHDT,90.00,T*2C\r\n");
    EXPECT_EQ(said[11].substr(0, 16), "$INZDA,221322.00");
    EXPECT_EQ(asked.front(), 25ms) << "0.400 s of the second";
    EXPECT_NEAR(to_seconds(asked.back()), 1.625, 1e-6);
}

TEST(NmeaIns, SaysEachWordAtItsRateAfterItsLatency) {
    Bench bench = unit("TSS1 GGA", {{"tss1", 25.0}, {"gga", 5.0}, {"latency", 0.25}});
    bench.run_to(249ms);
    EXPECT_TRUE(bench.sent().empty());
    bench.run_to(10s + 251ms);
    std::size_t positions = 0, attitudes = 0;
    for (const Send& send : bench.sent()) ++(send.bytes[0] == '$' ? positions : attitudes);
    EXPECT_EQ(positions, 51u);
    EXPECT_EQ(attitudes, 251u);
    Bench silent = unit("HDT", {{"hdt", 0.0}});
    silent.run_to(20s);
    EXPECT_TRUE(silent.sent().empty());
}

TEST(NmeaIns, Tss1IsAsItsMakersManualHasIt) {
    Bench bench = unit("TSS1");
    bench.where = [](Time time) {
        const double t = to_seconds(time);
        Located where{time, vessel(-3.25, 3.19, 0, {0, 0, 0.04 * std::floor(t / 0.02)}), {}};
        where.motion.velocity = {1.532 * t, 0, -0.5 * t};  // m/s: 40 steps across, 800 down
        return where;
    };
    bench.run_to(26ms);
    const auto said = lines(bench);
    ASSERT_EQ(said.size(), 2u);
    EXPECT_EQ(said[0], ":000000  0000F-0324  0319\r\n");
    EXPECT_EQ(said[1], ":28FCE0  0004F-0324  0319\r\n") << "heave rises at once, its mean in seconds";
}

/// sin of what it tells is sin of the roll times cos of the pitch: 30 deg and 45 deg make 20.70 deg. A
/// vehicle may pitch so much; it is no head that looks down.
TEST(NmeaIns, RollIsAgainstTheHorizonInTss1AndAboutThePitchedAxisElsewhere) {
    Bench bench = unit("TSS1 EM3000 PASHR");
    bench.where = [](Time time) { return Located{time, vessel(30, 45, 10), {}}; };
    bench.run_to(6ms);
    const auto said = lines(bench);
    ASSERT_EQ(said.size(), 3u);
    EXPECT_THAT(said[0], HasSubstr(",+30.00,+45.00,"));
    EXPECT_EQ(said[1].substr(14, 11), " 2070  4500");
    EXPECT_EQ(to_hex(Bytes(said[2].begin(), said[2].end())), "9090b80b94110000e803");
}

TEST(NmeaIns, EmAttitudeHasLowBytesFirst) {
    Bench bench = unit("EM3000");
    bench.where = [](Time time) {
        const bool later = time > 5ms;
        return Located{time, vessel(-3.25, 3.19, later ? 359.999 : 271.5, {0, 0, later ? -0.5 : 0}), {}};
    };
    bench.run_to(16ms);
    const auto sent = bench.sent();
    ASSERT_EQ(sent.size(), 2u);
    EXPECT_EQ(to_hex(sent[0].bytes), "9090bbfe3f0100000e6a");
    EXPECT_EQ(to_hex(sent[1].bytes), "9090bbfe3f01ceff0000") << "no heading of 360.00";
}

TEST(NmeaIns, NoFieldSays360Degrees) {
    Bench bench = unit("HDT VTG");
    bench.where = [](Time time) {
        Located where{time, vessel(0, 0, 359.997), {}};
        where.motion.velocity = {-1e-5, 1, 0};
        return where;
    };
    bench.run_to(6ms);
    const auto said = lines(bench);
    EXPECT_THAT(said[0], HasSubstr("VTG,0.00,T"));
    EXPECT_THAT(said[1], HasSubstr("HDT,0.00,T"));
}

TEST(NmeaIns, TellsEachEndpointItsOwnWords) {
    Bench bench = unit("GGA HDT; TSS1; EM3000", {},
                       {"serial:///dev/ttyUSB0:38400", "udp://127.0.0.1:10110",
                        "tcp-listen://127.0.0.1:10111", "udp://127.0.0.1:10112"});
    ASSERT_EQ(bench.device().ports().size(), 4u);
    EXPECT_GT(bench.device().ports()[2].drivers, 1u);
    bench.run_to(6ms);
    std::map<std::size_t, std::string> first;
    for (const Send& s : bench.sent()) {
        first[s.port] += to_hex(ByteView(s.bytes).first(2)) + ' ';
        EXPECT_EQ(s.to.port, s.port == 1 ? 10110 : s.port == 3 ? 10112 : 0);
    }
    EXPECT_EQ(first[0], "2449 2449 ");
    EXPECT_EQ(first[1], "3a30 ");
    EXPECT_EQ(first[2], "9090 ");
    EXPECT_EQ(first[3], "9090 ") << "beyond the lists: the last one";
}

TEST(NmeaIns, AWrongClockIsInTheStampsOnly) {
    Bench bench = unit("ZDA", {{"time_error", -18.0}});
    bench.run_to(6ms);
    EXPECT_THAT(lines(bench), ElementsAre("$INZDA,221302.00,14,11,2023,00,00*70\r\n"));
}

TEST(NmeaIns, SaysNothingOfALongPause) {
    Bench bench = unit("EM3000");
    bench.run_to(6ms);
    bench.now = 100s;
    bench.wake = 100s;
    bench.run_to(100s);
    EXPECT_LE(bench.sent().size(), 103u) << "what is older than a second is not said";
}

TEST(NmeaIns, SaysWhatDoesNotFit) {
    const auto refused = [](const std::string& words, const Options& changes = {},
                            const std::vector<std::string>& endpoints = one_line) {
        try {
            unit(words, changes, endpoints);
        } catch (const std::invalid_argument& e) {
            return std::string(e.what());
        }
        return std::string("taken");
    };
    EXPECT_THAT(refused("GGA RMC"), HasSubstr("'RMC' is not known"));
    EXPECT_THAT(refused(" "), HasSubstr("is told nothing"));
    EXPECT_THAT(refused(""), HasSubstr("is empty"));
    EXPECT_THAT(refused("GGA; HDT"), HasSubstr("2 lists for 1 endpoints"));
    EXPECT_THAT(refused("GGA", {{"talker", std::string("gps")}}), HasSubstr("two capital letters"));
    EXPECT_THAT(refused("TSS1", {{"baud", 9600.0}}), HasSubstr("13500 bit/s on a line of 9600"));
    EXPECT_EQ(refused("TSS1", {{"baud", 9600.0}}, {"udp://127.0.0.1:10110"}), "taken");
    EXPECT_EQ(refused("TSS1", {{"baud", 19200.0}}), "taken");
    EXPECT_THAT(refused("GGA", {}, {"udp-listen://127.0.0.1:10110"}), HasSubstr("udp://ADDRESS:PORT"));
}

TEST(NmeaIns, SensorsStrayAsTheProfileSays) {
    const Model& model = *find_model("nmea-ins");
    DeviceConfig config = make_config(model, {{"ports", std::string("EM3000")}});
    config.endpoints = parse_endpoints(one_line);
    config.effects = {};
    config.random_key = 7;
    config.profile["motion_noise"].value = 1.0;
    Bench bench(model.make(config));
    bench.run_to(4s);
    double sum = 0;
    const auto sent = bench.sent();
    for (const Send& s : sent) {
        const double roll = static_cast<std::int16_t>(s.bytes[2] | s.bytes[3] << 8) / 100.0;
        sum += roll * roll;
    }
    EXPECT_NEAR(std::sqrt(sum / static_cast<double>(sent.size())), 1, 0.15);
}

}  // namespace
}  // namespace echoloop::test
