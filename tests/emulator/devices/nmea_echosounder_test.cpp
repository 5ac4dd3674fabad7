// The NMEA echosounder on a bench: literal sentences at given times, echoes made up by the test. Depths
// follow from bins of 100 m / 6667, checksums were worked out by another program.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/emulator/devices/driver.h"

namespace echoloop::test {
namespace {
using namespace std::chrono_literals;
using testing::ElementsAre;

Bench sounder(const Options& changes = {}, std::vector<std::string> endpoints = {}) {
    Bench bench(make_device("nmea-echosounder", std::move(endpoints), changes));
    bench.echo_bin = 2000;  // 2000 x 100 m / 6667 = 30.00 m
    bench.echo_power = 1e12F;
    return bench;
}

std::vector<std::string> sentences(Bench& bench) {
    std::vector<std::string> all;
    for (const Send& s : bench.sent()) all.emplace_back(s.bytes.begin(), s.bytes.end());
    return all;
}

TEST(NmeaEchosounder, SpeaksOnceItHasListenedToTheEndOfItsRange) {
    Bench bench = sounder();
    bench.run_to(153ms);  // 2 x 100 m / 1500 m/s + 20 ms = 153.3 ms
    EXPECT_TRUE(bench.sent().empty());
    bench.run_to(154ms);
    EXPECT_THAT(sentences(bench),
                ElementsAre("$SDDPT,30.00,0.00,100.0*67\r\n", "$SDDBT,98.42,f,30.00,M,16.40,F*01\r\n",
                            "$SDMTW,10.0,C*05\r\n"));
}

TEST(NmeaEchosounder, PingsAtItsRate) {
    Bench bench = sounder();
    bench.run_to(5100ms);
    EXPECT_EQ(sentences(bench).size(), 5 * 3u);
    EXPECT_EQ(bench.device().counters().pings, 5u);
    EXPECT_EQ(bench.shots[4].ping, 5u);
    Bench fast = sounder({{"rate", 4.0}});
    fast.run_to(5100ms);
    EXPECT_EQ(sentences(fast).size(), 20 * 3u);
}

TEST(NmeaEchosounder, PingsNoFasterThanSoundComesBack) {
    Bench bench = sounder({{"rate", 20.0}, {"range", 750.0}});  // 1 s and 20 ms of processing
    bench.run_to(10300ms);
    EXPECT_EQ(bench.shots.size(), 10u);
    EXPECT_DOUBLE_EQ(bench.shots[0].interval, 1.02);
}

TEST(NmeaEchosounder, NeverSaysMoreThanTheLineCarries) {
    const auto pings = [](double baud, std::vector<std::string> endpoints) {
        Bench bench = sounder({{"rate", 20.0}, {"range", 10.0}, {"baud", baud}}, std::move(endpoints));
        bench.run_to(10s);
        std::size_t bytes = 0;
        for (const std::string& s : sentences(bench)) bytes += s.size();
        if (baud > 0 && bench.device().ports()[0].kind == Port::Kind::stream) {
            EXPECT_LE(static_cast<double>(bytes) * 10 / baud, 10.2);
        }
        return bench.shots.size();
    };
    EXPECT_LT(pings(4800, {}), 80u) << "some 65 bytes a ping";
    EXPECT_GT(pings(4800, {}), 50u) << "the line is used";
    EXPECT_GE(pings(38400, {}), 199u);
    EXPECT_GE(pings(0, {}), 199u);
    EXPECT_GE(pings(4800, {"udp://127.0.0.1:10110"}), 199u) << "datagrams know no baud";
}

TEST(NmeaEchosounder, LeavesDepthsNullWithoutABottom) {
    Bench bench = sounder();
    bench.echo_power = 0;
    bench.run_to(200ms);
    EXPECT_THAT(sentences(bench),
                ElementsAre("$SDDPT,,0.00,100.0*4A\r\n", "$SDDBT,,f,,M,,F*28\r\n", "$SDMTW,10.0,C*05\r\n"));
    Bench silent = sounder({{"no_bottom", std::string("silent")}});
    silent.echo_power = 0;
    silent.run_to(200ms);
    EXPECT_THAT(sentences(silent), ElementsAre("$SDMTW,10.0,C*05\r\n"));
}

TEST(NmeaEchosounder, ItsSoundSpeedScalesItsDepth) {
    Bench bench = sounder({{"sound_speed", 1450.0}, {"sentences", std::string("DPT")}});
    bench.run_to(200ms);  // the echo after 40 ms again: 29 m
    EXPECT_THAT(sentences(bench), ElementsAre("$SDDPT,29.00,0.00,100.0*6F\r\n"));
}

TEST(NmeaEchosounder, OffsetLeadsToTheSurfaceOrToTheKeel) {
    Bench surface =
        sounder({{"offset", 1.5}, {"dpt_fields", std::string("2")}, {"sentences", std::string("DPT DBS")}});
    surface.run_to(200ms);
    EXPECT_THAT(sentences(surface),
                ElementsAre("$SDDPT,30.00,1.50*60\r\n", "$SDDBS,103.34,f,31.50,M,17.22,F*35\r\n"));
    Bench keel = sounder({{"offset", -1.5},
                          {"talker", std::string("II")},
                          {"decimals", std::int64_t{1}},
                          {"dpt_fields", std::string("2")},
                          {"sentences", std::string("DPT DBK")}});
    keel.run_to(200ms);
    EXPECT_THAT(sentences(keel),
                ElementsAre("$IIDPT,30.0,-1.5*5A\r\n", "$IIDBK,93.5,f,28.5,M,15.6,F*3C\r\n"));
}

TEST(NmeaEchosounder, ServesSeveralPlacesAtOnce) {
    Bench bench =
        sounder({{"sentences", std::string("DPT")}},
                {"serial:///dev/ttyUSB0:4800", "udp://127.0.0.1:10110", "tcp-listen://127.0.0.1:10111"});
    const auto ports = bench.device().ports();
    ASSERT_EQ(ports.size(), 3u);
    EXPECT_GT(ports[2].drivers, 1u) << "several programs may connect";
    bench.run_to(160ms);
    const auto sent = bench.sent();
    ASSERT_EQ(sent.size(), 3u);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(sent[i].port, i);
        EXPECT_EQ(sent[i].bytes, sent[0].bytes);
    }
    EXPECT_EQ(sent[1].to, (Address{0x7F000001, 10110}));
}

TEST(NmeaEchosounder, SendsEachSentenceAsADatagramToItsHost) {
    Bench bench = sounder({}, {"udp://10.0.1.102:10110?local_port=10111"});
    const auto ports = bench.device().ports();
    ASSERT_EQ(ports.size(), 1u);
    EXPECT_EQ(ports[0].kind, Port::Kind::datagram);
    EXPECT_EQ(ports[0].bind, (Address{0, 10111}));
    bench.run_to(200ms);
    const auto sent = bench.sent();
    ASSERT_EQ(sent.size(), 3u);
    for (const Send& s : sent) EXPECT_EQ(s.to, (Address{0x0A000166, 10110}));
    EXPECT_EQ(make_device("nmea-echosounder", {"udp://127.0.0.1:10110"})->ports()[0].bind,
              (Address{0x7F000001, 0}))
        << "from loopback to loopback";
}

TEST(NmeaEchosounder, TakesNoNoticeOfWhatItsHostSays) {
    Bench bench = sounder();
    bench.say("245344445054");
    bench.run_to(200ms);
    EXPECT_EQ(sentences(bench).size(), 3u);
    EXPECT_EQ(bench.device().counters().skipped_bytes, 6u);
}

TEST(NmeaEchosounder, SaysWhatDoesNotFit) {
    const auto refused = [](const Options& changes, std::vector<std::string> endpoints = {}) {
        try {
            make_device("nmea-echosounder", std::move(endpoints), changes);
        } catch (const std::invalid_argument& e) {
            return std::string(e.what());
        }
        return std::string("taken");
    };
    using testing::HasSubstr;
    EXPECT_THAT(refused({{"talker", std::string("sd")}}), HasSubstr("two capital letters"));
    EXPECT_THAT(refused({{"sentences", std::string("DPT GGA")}}), HasSubstr("'GGA' is not known"));
    EXPECT_THAT(refused({{"sentences", std::string("  ")}}), HasSubstr("empty"));
    EXPECT_THAT(refused({{"sentences", std::string("DBS")}, {"offset", -1.0}}), HasSubstr("water line"));
    EXPECT_THAT(refused({{"sentences", std::string("DBK")}, {"offset", 1.0}}), HasSubstr("keel"));
    EXPECT_THAT(refused({}, {"udp-listen://127.0.0.1:10110"}), HasSubstr("udp://ADDRESS:PORT"));
    EXPECT_THAT(refused({}, std::vector<std::string>(9, "pty:/tmp/a")), HasSubstr("one to 8"));
}

TEST(NmeaEchosounder, HasAConicalBeam) {
    Bench bench = sounder();
    bench.run_to(200ms);
    const Shot& shot = bench.shots.at(0);
    EXPECT_DOUBLE_EQ(shot.beam_width, deg_to_rad(12));
    EXPECT_DOUBLE_EQ(shot.fan_height, deg_to_rad(12));
    EXPECT_EQ(shot.horizontal, (AxisPattern{ApertureShape::piston, 2}));
    EXPECT_EQ(shot.vertical, (AxisPattern{ApertureShape::piston, 2}));
    EXPECT_EQ(shot.bearings, std::vector<double>{0});
    EXPECT_NEAR(static_cast<double>(shot.bins) * shot.bin_interval, 2 * 100 / 1500.0, 1e-9);
}

}  // namespace
}  // namespace echoloop::test
