// A Nortek Nucleus on the bench: frames are read at the offsets of the maker's driver, never by the project's
// codec.
#include <gtest/gtest.h>

#include <cstring>

#include "tests/emulator/devices/doppler_echo.h"

namespace echoloop::test {
namespace {

using namespace std::chrono_literals;

enum NucleusPort : std::size_t { command_port, data_port, line_port };

float f32(const Bytes& b, std::size_t at) {
    float value = 0;
    std::memcpy(&value, b.data() + at, sizeof value);
    return value;
}
unsigned u32(const Bytes& b, std::size_t at) {
    unsigned value = 0;
    std::memcpy(&value, b.data() + at, sizeof value);
    return value;
}

struct Nucleus {
    explicit Nucleus(const Options& changes = {})
        : bench(make_device(
              "nortek-nucleus",
              {"tcp-listen://127.0.0.1:9000", "tcp-listen://127.0.0.1:9002", "pty:/tmp/echoloop/n"},
              changes)) {}

    /// What a port has said since the last call, until `end`.
    std::vector<Bytes> said(Time end, std::size_t port = line_port) {
        bottom.run(bench, end);
        std::vector<Bytes> out;
        for (const Send& send : bench.sent())
            if (send.port == port) out.push_back(send.bytes);
        return out;
    }
    std::string ask(const std::string& line, std::size_t port = line_port) {
        bench.sent();
        const std::string ended = line + "\r\n";
        bench.say(Bytes(ended.begin(), ended.end()), port);
        std::string text;
        for (const Send& send : bench.sent())
            if (send.port == port && send.bytes[0] != 0xA5) text.append(send.bytes.begin(), send.bytes.end());
        return text;
    }
    /// The data of the last frame with that id until `end`.
    Bytes last(std::uint8_t id, Time end) {
        Bytes out;
        for (const Bytes& one : said(end))
            if (one[0] == 0xA5 && one[2] == id) out.assign(one.begin() + 10, one.end());
        return out;
    }

    Bench bench;
    OverBottom bottom;
};

TEST(Nucleus1000, TellsVelocitiesRangesAndTheAltimeter) {
    Nucleus n;
    n.bottom.velocity = {0.2, 0.5, -0.1};
    n.bottom.orientation = axis_angle({0, 0, 1}, deg_to_rad(90));
    EXPECT_TRUE(n.said(2s).empty()) << "nothing before START";
    EXPECT_EQ(n.ask("START"), "OK\r\n");
    const Bytes track = n.last(0xB4, 4s);
    ASSERT_EQ(track.size(), 128U);
    EXPECT_EQ(u32(track, 12), 0x7FFFU);
    EXPECT_NEAR(f32(track, 96), 0.5, 1e-3) << "forward";
    EXPECT_NEAR(f32(track, 100), 0.2, 1e-3) << "starboard";
    EXPECT_NEAR(f32(track, 104), 0.1, 1e-3) << "down";
    for (std::size_t beam = 0; beam < 3; ++beam) {
        const double azimuth = deg_to_rad(120.0 * static_cast<double>(beam)), tilt = deg_to_rad(25);
        const double along =
            std::sin(tilt) * (0.5 * std::cos(azimuth) + 0.2 * std::sin(azimuth)) + 0.1 * std::cos(tilt);
        EXPECT_NEAR(f32(track, 36 + 4 * beam), along, 1e-3) << beam;
        EXPECT_NEAR(f32(track, 48 + 4 * beam), 5, 0.025) << beam;
    }
    const Bytes altimeter = n.last(0xAA, 6s);
    ASSERT_EQ(altimeter.size(), 42U);
    EXPECT_EQ(u32(altimeter, 12) & 3, 3U);
    EXPECT_NEAR(f32(altimeter, 36), 5, 0.025);
}

TEST(Nucleus1000, PortIsNotStarboard) {
    for (const auto& [bearing, beam] : {std::pair{0.0, 0U}, {120.0, 1U}, {-120.0, 2U}}) {
        Nucleus n({{"starts_at_once", true}});
        n.bottom.deaf = bearing;
        const Bytes track = n.last(0xB4, 4s);
        for (std::size_t i = 0; i < 3; ++i) {
            EXPECT_EQ(f32(track, 36 + 4 * i) == -32.768F, i == beam) << bearing;
            EXPECT_EQ(f32(track, 48 + 4 * i) == 0, i == beam);
        }
        EXPECT_EQ(f32(track, 96), -32.768F) << "two beams tell no velocity";
        EXPECT_EQ(f32(track, 108), 10);
    }
}

TEST(Nucleus1000, WithoutABottomItSaysSo) {
    Nucleus n({{"starts_at_once", true}});
    n.bottom.altitude = 0;
    const Bytes track = n.last(0xB4, 5s);
    EXPECT_EQ(u32(track, 12), 0U);
    EXPECT_EQ(f32(track, 96), -32.768F);
    EXPECT_EQ(f32(n.last(0xAA, 8s), 36), 0);
}

TEST(Nucleus1000, AttitudeIsThatOfTheMount) {
    Nucleus n({{"starts_at_once", true}});
    n.bench.where = [](Time time) {
        Located at{time, {}, {}};
        at.world_from_device.orientation = axis_angle({0, 0, 1}, deg_to_rad(60)) *
                                           axis_angle({0, 1, 0}, deg_to_rad(-12)) *
                                           axis_angle({1, 0, 0}, deg_to_rad(8));
        at.world_from_device.position = {0, 0, -12};
        return at;
    };
    const Bytes ahrs = n.last(0xD2, 1s);
    ASSERT_EQ(ahrs.size(), 108U);
    EXPECT_NEAR(f32(ahrs, 36), 8, 0.01) << "starboard down";
    EXPECT_NEAR(f32(ahrs, 40), 12, 0.01) << "bow up";
    EXPECT_NEAR(f32(ahrs, 44), 30, 0.01) << "clockwise from north";
    EXPECT_NEAR(f32(ahrs, 104), 12, 0.01);
}

TEST(Nucleus1000, LogsItsHostInByTcp) {
    Nucleus n({{"starts_at_once", true}});
    n.bench.sent();
    n.bench.connect(command_port, {0x7F000001, 5000});
    auto said = n.said(n.bench.now, command_port);
    ASSERT_EQ(said.size(), 1U);
    EXPECT_EQ(std::string(said[0].begin(), said[0].end()), "Please enter password:\r\n");
    EXPECT_TRUE(n.said(3s, command_port).empty()) << "no data before the login";
    EXPECT_EQ(n.ask("wrong", command_port), "Wrong password\r\nPlease enter password:\r\n");
    EXPECT_TRUE(n.ask("nortek", command_port).starts_with("Welcome to Nortek"));
    EXPECT_FALSE(n.said(6s, command_port).empty());
    EXPECT_FALSE(n.said(9s, data_port).empty()) << "the other port wants none";
}

TEST(Nucleus1000, AnswersAsTheMakersDriverNeedsIt) {
    Nucleus n;
    const std::string clock = n.ask("SETCLOCKSTR,TIME=\"2026-11-27 12:30:15\"");
    EXPECT_EQ(clock, "OK\r\n");
    const std::string all = n.ask("$PNOR,GETALL*38");
    EXPECT_GE(std::count(all.begin(), all.end(), '\n'), 15);
    EXPECT_TRUE(all.ends_with("$PNOR,OK*2B\r\n"));
    EXPECT_NE(all.find("$PNOR,GETFW,STR=\"4.0.0\"*18\r\n"), std::string::npos);
    EXPECT_EQ(n.ask("SETTRIG,SRC=\"INTERNAL\",FREQ=8"), "OK\r\n");
    EXPECT_NE(n.ask("GETTRIG").find("FREQ=8"), std::string::npos);
    EXPECT_NE(n.ask("GETTRIGLIM").find("[1;8]"), std::string::npos);
    for (const char* bad :
         {"SETTRIG,FREQ=80", "SETTRIG,FREQ=x", "SETBT,MODE=\"NONE\"", "SETBT,NO=1", "NO", "TRIG",
          "SETCLOCKSTR,TIME=\"2026-13-27 12:30:15\"", "SETBT,MODE", "$PNOR,GETALL*39", "GETLIM"}) {
        const std::string answer = n.ask(bad);
        EXPECT_TRUE(answer == "ERROR\r\n" || answer == "$PNOR,ERROR*77\r\n") << bad << answer;
    }
    EXPECT_TRUE(n.ask("GETERROR").ends_with("OK\r\n"));
    EXPECT_EQ(n.ask("START"), "OK\r\n");
    const unsigned before = static_cast<unsigned>(n.said(5s).size());
    EXPECT_NEAR(before, 5 * (2 * 8 + 10), 12) << "track and altimeter 8 times a second, attitude 10 times";
    EXPECT_EQ(n.ask("STOP"), "OK\r\n");
    EXPECT_TRUE(n.said(8s).empty());
}

TEST(Nucleus1000, PingsByCommandAndLeavesOutStreams) {
    Nucleus n;
    n.ask("SETTRIG,SRC=\"COMMAND\"");
    n.ask("SETAHRS,DS=\"OFF\"");
    n.ask("SETALTI,DS=\"OFF\"");
    n.ask("START");
    EXPECT_TRUE(n.said(3s).empty());
    EXPECT_EQ(n.ask("TRIG"), "OK\r\n");
    EXPECT_EQ(n.said(6s).size(), 1U);
    EXPECT_EQ(n.ask("TRIG"), "OK\r\n");
    EXPECT_EQ(n.said(9s).size(), 1U);
}

TEST(Nucleus1000, NoiseOnTheLineCannotWedgeIt) {
    Nucleus n;
    std::uint32_t state = 1;
    for (int i = 0; i < 4000; ++i) {
        state = state * 1664525U + 1013904223U;
        n.bench.say(Bytes{static_cast<std::uint8_t>(state >> 24)}, line_port);
    }
    n.ask("");
    EXPECT_EQ(n.ask("START"), "OK\r\n");
}

}  // namespace
}  // namespace echoloop::test
