// Nortek DVLs on the bench: frames are read at the offsets of public readers of DF21, lines by their commas,
// never by the project's codec.
#include <gtest/gtest.h>

#include <cstring>
#include <map>
#include <numbers>
#include <tuple>

#include "emulator/devices/family/doppler/echo.h"
#include "render/water.h"
#include "tests/emulator/devices/doppler_echo.h"

namespace echoloop::test {
namespace {

using namespace std::chrono_literals;

enum DvlPort : std::size_t { commands, data, text, line, datagrams };
constexpr Address host{0x7F000001, 9005};

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
std::string as_text(const Bytes& bytes) { return {bytes.begin(), bytes.end()}; }

std::vector<std::string> fields_of(const std::string& line) {
    std::vector<std::string> fields{""};
    for (const char c : line.substr(0, line.find('*')))
        if (c == ',')
            fields.emplace_back();
        else
            fields.back() += c;
    return fields;
}

struct NortekDvl {
    explicit NortekDvl(const Options& changes = {}, const std::string& model = "nortek-dvl1000")
        : bench(make_device(model,
                            {"tcp-listen://127.0.0.1:9000", "tcp-listen://127.0.0.1:9002",
                             "tcp-listen://127.0.0.1:9004", "pty:/tmp/echoloop/n", "udp://127.0.0.1:9005"},
                            changes)) {}

    /// What a port has said since the last call, until `end`.
    std::vector<Bytes> said(Time end, std::size_t port = line) {
        bottom.run(bench, end);
        std::vector<Bytes> out;
        for (const Send& send : bench.sent())
            if (send.port == port) out.push_back(send.bytes);
        return out;
    }
    std::string ask(const std::string& words, std::size_t port = line, const std::string& end = "\r\n") {
        bench.sent();
        const std::string ended = words + end;
        bench.say(Bytes(ended.begin(), ended.end()), port);
        std::string heard;
        for (const Send& send : bench.sent())
            if (send.port == port && send.bytes[0] != 0xA5) heard += as_text(send.bytes);
        return heard;
    }
    void go_to_command_mode() {
        ask("K1W%!Q", line, "");
        EXPECT_EQ(ask("MC"), "OK\r\n");
    }
    /// The data of the last frame with that id until `end`.
    Bytes last(Time end, std::uint8_t id = 0x1B) {
        Bytes out;
        for (const Bytes& one : said(end))
            if (one[0] == 0xA5 && one[2] == id && one[3] == 0x10) out.assign(one.begin() + 10, one.end());
        return out;
    }
    std::string last_line(Time end, std::size_t port = line) {
        std::string out;
        for (const Bytes& one : said(end, port)) out = as_text(one);
        return out;
    }

    Bench bench;
    OverBottom bottom;
};

/// Azimuth of beams 1 to 4, deg clockwise from ahead.
constexpr double azimuths[] = {45, -45, -135, 135};

TEST(NortekDvl, Df21TellsBeamsAndComponents) {
    for (const char* model : {"nortek-dvl1000", "nortek-dvl500"}) {
        NortekDvl n({}, model);
        n.bottom.velocity = {0.2, 0.5, -0.1};
        n.bottom.orientation = axis_angle({0, 0, 1}, deg_to_rad(90));
        const Bytes d = n.last(4s);
        ASSERT_EQ(d.size(), 212U);
        EXPECT_EQ(d[0], 1);
        EXPECT_EQ(d[1], 36);
        EXPECT_EQ(d[14], 4) << "beams";
        EXPECT_EQ(u32(d, 16), 0U) << "error";
        EXPECT_EQ(u32(d, 20), 0x100FFFFFU) << "all valid, woken by its power";
        EXPECT_EQ(f32(d, 24), 1500);
        const double tilt = deg_to_rad(25);
        for (std::size_t beam = 0; beam < 4; ++beam) {
            const double a = deg_to_rad(azimuths[beam]);
            const double along =
                std::sin(tilt) * (0.5 * std::cos(a) + 0.2 * std::sin(a)) + 0.1 * std::cos(tilt);
            EXPECT_NEAR(f32(d, 36 + 4 * beam), along, 1e-3) << model << beam;
            EXPECT_NEAR(f32(d, 52 + 4 * beam), 5, 0.025) << "vertical";
            const float merit = f32(d, 68 + 4 * beam);
            EXPECT_GT(merit, 1e-3F);
            EXPECT_LT(merit, 5e-3F);
            const double way = 2 * 5 / std::cos(tilt) / 1500;
            EXPECT_NEAR(f32(d, 84 + 4 * beam), way, 2e-3) << "from the trigger to the middle of the echo";
            EXPECT_LT(f32(d, 100 + 4 * beam), 0) << "the echo was before the report";
            EXPECT_GT(f32(d, 116 + 4 * beam), 0);
        }
        for (const auto& [at, value] : {std::pair{132U, 0.5}, {136U, 0.2}, {140U, 0.1}, {144U, 0.1}})
            EXPECT_NEAR(f32(d, at), value, 1e-3) << model << at;
        const double beam_merit = f32(d, 68);
        EXPECT_NEAR(f32(d, 148) / beam_merit, 2 / (2 * std::sqrt(2) * std::sin(tilt)), 0.4) << "x";
        EXPECT_NEAR(f32(d, 156) / beam_merit, std::sqrt(2) / (2 * std::cos(tilt)), 0.2) << "z1";
    }
}

TEST(NortekDvl, Dt2IsCountedFromTheReport) {
    NortekDvl n;
    n.bottom.run(n.bench, 4s);
    n.bench.sent();
    const Time before = n.bench.now;
    while (n.said(n.bench.now + 1ms).empty()) ASSERT_LT(n.bench.now, before + 2s);
    const Time report = n.bench.now;
    const Bytes d = n.last(report + 250ms);
    ASSERT_EQ(d.size(), 212U);
    const Shot& shot = n.bench.shots.back();
    EXPECT_NEAR(f32(d, 84) - f32(d, 100), static_cast<double>(shot.bins) * shot.bin_interval + 0.03, 1e-3);
}

TEST(NortekDvl, PortIsNotStarboard) {
    for (std::size_t beam = 0; beam < 4; ++beam) {
        NortekDvl n;
        n.bottom.velocity = {0.5, -0.2,
                             -0.1};  // east, north, up of a log that looks east: ahead, starboard, down
        n.bottom.deaf = azimuths[beam];
        const Bytes d = n.last(4s);
        ASSERT_EQ(d.size(), 212U);
        for (std::size_t i = 0; i < 4; ++i) {
            EXPECT_EQ(f32(d, 36 + 4 * i) == -32.768F, i == beam) << beam;
            EXPECT_EQ(f32(d, 52 + 4 * i) == 0, i == beam);
            EXPECT_EQ(f32(d, 68 + 4 * i) == 10, i == beam);
        }
        const unsigned others = 0xFU & ~(1U << beam);
        EXPECT_EQ(u32(d, 20), 0x10077000U | others * 0x111U) << "x, y and z1, as published reports have it";
        EXPECT_NEAR(f32(d, 132), 0.5, 1e-3) << "three beams are enough";
        EXPECT_NEAR(f32(d, 136), 0.2, 1e-3);
        EXPECT_NEAR(f32(d, 140), 0.1, 1e-3) << "z1 is of the pair that heard";
        EXPECT_EQ(f32(d, 144), -32.768F);
        EXPECT_EQ(f32(d, 160), 10);
    }
}

TEST(NortekDvl, WithoutABottomItSaysSo) {
    NortekDvl n;
    n.bottom.altitude = 0;
    const Bytes d = n.last(5s);
    ASSERT_EQ(d.size(), 212U);
    EXPECT_EQ(u32(d, 20), 0x10000000U);
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_EQ(f32(d, 36 + 4 * i), -32.768F);
        EXPECT_EQ(f32(d, 52 + 4 * i), 0);
        EXPECT_EQ(f32(d, 132 + 4 * i), -32.768F);
        EXPECT_EQ(f32(d, 148 + 4 * i), 10);
    }
}

TEST(NortekDvl, AFarBottomIsNotTakenForTheWaterBeforeTheFace) {
    EXPECT_NEAR(doppler::usual_absorption(1e6), absorption_db_per_km({}, 1e6) / 1000, 0.004);
    EXPECT_NEAR(doppler::usual_absorption(420e3), absorption_db_per_km({}, 420e3) / 1000, 0.001);
    for (const char* model : {"nortek-dvl1000", "dvl-a50", "nortek-nucleus"}) {
        OverBottom bottom;
        bottom.altitude = 45;
        bottom.floating = 5e13;
        const Shot shot = find_model(model)->default_shot(make_config(*find_model(model)), 0, 50);
        const Echogram heard = bottom.hear(shot, {});
        doppler::Settings settings;
        settings.acoustics.tilt = std::numbers::pi / 2 - shot.sides[0].depression;
        settings.acoustics.beam_width = shot.beam_width;
        settings.acoustics.detection = 13;
        const auto echo = doppler::find_bottom_echo(heard, 0, settings);
        ASSERT_TRUE(echo) << model;
        EXPECT_NEAR(echo->time * 750, 45 / std::cos(settings.acoustics.tilt), 0.5) << model;
    }
    NortekDvl n;
    n.bottom.altitude = 60;
    n.bottom.floating = 5e12;
    EXPECT_EQ(u32(n.last(8s), 20), 0x100FFFFFU);
}

TEST(NortekDvl, TimeIsThatOfTheTrigger) {
    NortekDvl n;
    n.go_to_command_mode();
    EXPECT_EQ(n.ask("SETCLOCK,YEAR=2026,MONTH=11,DAY=27,HOUR=12,MINUTE=30,SECOND=15"), "OK\r\n");
    EXPECT_EQ(n.ask("GETCLOCKSTR"), "GETCLOCKSTR,TIME=\"2026-11-27 12:30:15\"\r\nOK\r\n");
    EXPECT_EQ(n.ask("START"), "OK\r\n");
    const Bytes d = n.last(1s);
    ASSERT_EQ(d.size(), 212U);
    const Bytes wanted{126, 10, 27, 12, 30, 15};
    EXPECT_EQ(Bytes(d.begin() + 6, d.begin() + 12), wanted) << "years from 1900, months from 0";
    EXPECT_EQ(u32(d, 20) >> 28, 2U) << "woken by a break";
    EXPECT_EQ((d[12] + 256 * d[13]) % 2500, 0) << "in units of 100 us, four times a second";
}

TEST(NortekDvl, LinesAreThoseOfTheFormat) {
    const auto start = [](const char* format) { return Options{{"bottom_format", std::string(format)}}; };
    for (const auto& [format, address, count] :
         {std::tuple{"bt7", "$PNORBT7", 12U}, {"bt9", "$PNORBT9", 17U}, {"bt4", "$PNORBT4", 7U}}) {
        NortekDvl n(start(format));
        n.bottom.velocity = {0.5, -0.2, -0.1};
        const std::string said = n.last_line(4s);
        EXPECT_LT(said.size(), 140U);
        ASSERT_TRUE(said.ends_with("\r\n")) << said;
        const auto fields = fields_of(said);
        EXPECT_EQ(fields[0], address);
        ASSERT_EQ(fields.size(), count) << said;
        if (count == 7U) {
            EXPECT_NEAR(std::stod(fields[3]), std::hypot(0.5, 0.2), 2e-3) << "speed";
            EXPECT_NEAR(std::stod(fields[4]), rad_to_deg(std::atan2(0.2, 0.5)), 0.3) << "clockwise from x";
            EXPECT_NEAR(std::stod(fields[6]), 5, 0.06);
            continue;
        }
        EXPECT_NEAR(std::stod(fields[2]), 1e3 * 2 * 5 / std::cos(deg_to_rad(25)) / 1500, 2) << "ms";
        EXPECT_NEAR(std::stod(fields[4]), 0.5, 1e-3);
        EXPECT_NEAR(std::stod(fields[5]), 0.2, 1e-3);
        EXPECT_NEAR(std::stod(fields[6]), 0.1, 1e-3);
        for (std::size_t i = 8; i < 12; ++i) EXPECT_NEAR(std::stod(fields[i]), 5, 0.03);
        if (count == 17U) {
            EXPECT_EQ(fields[16], "0x100FFFFF");
        }
    }
    NortekDvl tags(start("bt8"));
    const std::string said = tags.last_line(4s);
    for (const char* tag : {"$PNORBT8,TIME=", ",DT1=", ",VX=", ",FOM=", ",D4=5.0",
                            ",BATT=24.0,SS=1500.0,PRESS=", ",STAT=0x100FFFFF*"})
        EXPECT_NE(said.find(tag), std::string::npos) << tag << said;
    NortekDvl beams(start("bt0"));
    int of_beams = 0;
    for (const Bytes& one : beams.said(4s)) of_beams += as_text(one).starts_with("$PNORBT0,3,") ? 1 : 0;
    EXPECT_NEAR(of_beams, 16, 2) << "one line for each beam, four times a second";
    NortekDvl lost(start("bt7"));
    lost.bottom.altitude = 0;
    EXPECT_NE(lost.last_line(4s).find(",-32.7680,-32.7680,-32.7680,10.00000,0.00,0.00,0.00,0.00*"),
              std::string::npos);
}

TEST(NortekDvl, WaterTrackFollowsTheBottomTrack) {
    NortekDvl n({{"water_track", true}});
    n.bottom.velocity = {0.5, -0.2, 0};
    const Bytes d = n.last(4s, 0x1D);
    ASSERT_EQ(d.size(), 212U);
    EXPECT_EQ(u32(d, 20), 0x100FFFFFU);
    EXPECT_NEAR(f32(d, 132), 0.5, 2e-3);
    EXPECT_NEAR(f32(d, 136), 0.2, 2e-3);
    EXPECT_EQ(f32(d, 52), 3) << "to the layer";
    n.bottom.altitude = 0;
    EXPECT_EQ(u32(n.last(8s, 0x1D), 20), 0x100FFFFFU) << "it needs no bottom";
    n.bottom.altitude = 2;
    EXPECT_EQ(u32(n.last(12s, 0x1D), 20), 0x10000000U) << "there is no water where the layer is";
    n.go_to_command_mode();
    EXPECT_EQ(n.ask("SETBT,WTDF=409"), "OK\r\n");
    EXPECT_EQ(n.ask("START"), "OK\r\n");
    EXPECT_TRUE(n.last_line(14s).starts_with("$PNORWT9,"));
}

TEST(NortekDvl, PortsTellWhatTheyAreFor) {
    NortekDvl n;
    n.bench.sent();
    n.bench.connect(data, {0x7F000001, 5000});
    n.bench.connect(text, {0x7F000001, 5001});
    std::size_t greetings = 0;
    for (const Send& send : n.bench.sent()) {
        EXPECT_EQ(as_text(send.bytes), "\r\nNortek NORTEK-100500 Data Interface\r\n");
        EXPECT_EQ(send.to.port, send.port == data ? 5000 : 5001);
        ++greetings;
    }
    EXPECT_EQ(greetings, 2U);
    n.bottom.run(n.bench, 2s);
    std::map<std::size_t, int> frames;
    for (const Send& send : n.bench.sent()) {
        ++frames[send.port];
        if (send.port == datagrams) {
            EXPECT_EQ(send.to, host);
        }
    }
    EXPECT_EQ(frames[commands], 0) << "nobody has logged in";
    EXPECT_NEAR(frames[data], 8, 1);
    EXPECT_EQ(frames[text], 0) << "DF21 is no text";
    EXPECT_EQ(frames[line], frames[data]);
    EXPECT_EQ(frames[datagrams], frames[data]);
    NortekDvl lines({{"bottom_format", std::string("bt9")}});
    EXPECT_FALSE(lines.said(2s, text).empty());
}

TEST(NortekDvl, LogsItsHostInAsDuneDoes) {
    NortekDvl n;
    n.bench.sent();
    n.bench.connect(commands, {0x7F000001, 5000});
    auto said = n.said(n.bench.now, commands);
    ASSERT_EQ(said.size(), 1U);
    EXPECT_EQ(as_text(said[0]), "Username: ");
    EXPECT_EQ(n.ask("nortek", commands, "\n"), "Password: ");
    EXPECT_TRUE(n.ask("", commands, "\n").ends_with("Nortek DVL1000 Command Interface\r\n")) << "any will do";
    EXPECT_FALSE(n.said(2s, commands).empty()) << "who is in gets data";
    EXPECT_TRUE(n.ask("K1W%!Q", commands).ends_with("OK\r\n"));
    EXPECT_TRUE(n.said(4s, commands).empty()) << "a break stops them";
    EXPECT_EQ(n.ask("MC", commands), "OK\r\n");
    EXPECT_EQ(n.ask("SETDVL,0,\"OFF\",\"INTSR\",8.0,\"\",0.0,20.0", commands), "OK\r\n");
    EXPECT_EQ(n.ask("SETBT,30.00,4.00,4,0,21,-20.0,\"XYZ\"", commands), "OK\r\n");
    EXPECT_EQ(n.ask("GETDVL,SR,SA", commands), "GETDVL,SR=8.0,SA=20.0\r\nOK\r\n");
    EXPECT_EQ(n.ask("GETBT,PL", commands), "GETBT,PL=-20.0\r\nOK\r\n");
    EXPECT_EQ(n.ask("START", commands), "OK\r\n");
    const auto frames = n.said(6s, commands);
    EXPECT_NEAR(static_cast<double>(frames.size()), 16, 1) << "8 Hz";
    EXPECT_NEAR(f32(frames.back(), 10 + 24), 1449.2 + 46 - 5.5 + 0.29 - 1.24 * 15, 0.5)
        << "measured, of 10 degC and 20";
    EXPECT_NEAR(n.bench.shots.back().source_level, 197, 1e-6) << "20 dB less";

    NortekDvl other({{"password", std::string("secret")}, {"login", std::string("telnet")}});
    other.bench.connect(commands, {0x7F000001, 5000});
    other.ask("nortek", commands);
    EXPECT_EQ(other.ask("wrong", commands), "\r\nLogin failed\r\nUsername: ");
    other.ask("nortek", commands);
    EXPECT_TRUE(other.ask("secret", commands).ends_with("Command Interface\r\r\n"));
    NortekDvl as_nucleus({{"password", std::string("nortek")}, {"login", std::string("password")}});
    as_nucleus.bench.sent();
    as_nucleus.bench.connect(commands, {0x7F000001, 5000});
    EXPECT_EQ(as_text(as_nucleus.bench.sent().at(0).bytes), "Please enter password:\r\n");
    EXPECT_TRUE(as_nucleus.ask("nortek", commands).starts_with("Welcome to Nortek"));
}

TEST(NortekDvl, RefusesWhatIsNotLegal) {
    NortekDvl n;
    EXPECT_EQ(n.ask("SETBT,VR=4"), "ERROR\r\n") << "while it measures";
    EXPECT_EQ(n.ask("GETBT,VR"), "GETBT,VR=5\r\nOK\r\n");
    n.go_to_command_mode();
    EXPECT_EQ(n.ask("SETDVL,TRIG=\"TTLRISE\",SR=5.000000,SA=35.000000,"), "OK\r\n")
        << "DUNE ends it with a comma";
    EXPECT_EQ(
        n.ask(
            "SETBT,RANGE=50.00,VR=5.00,NB=4,CH=0,DF=359,PL=-2.0,WT=\"OFF\",WTDF=409,BD=0.01,PLMODE=\"MAX\""),
        "OK\r\n");
    for (const char* bad : {"SETDVL,SR=9", "SETDVL,SV=5", "SETDVL,TRIG=\"NONE\"", "SETBT,DF=353",
                            "SETBT,DF=2", "SETBT,WTDF=21", "SETBT,PL=3", "SETBT,NO=1", "SETBT,VR=nan",
                            "SETCLOCK,YEAR=2026", "SETCLOCKSTR,TIME=\"2026-13-27 12:30:15\"", "NO", "TRIG",
                            "GETLIM", "SETDVL,1,2,3,4,5,6,7,8,9", "$PNOR,GETBT*00", "CO"})
        EXPECT_TRUE(n.ask(bad) == "ERROR\r\n" || n.ask(bad) == "$PNOR,ERROR*77\r\n") << bad;
    EXPECT_NE(n.ask("GETERROR").find("OK\r\n"), std::string::npos);
    EXPECT_NE(n.ask("GETBTLIM").find("DF=[21;350;351;354;"), std::string::npos);
    EXPECT_EQ(n.ask("GETDVLLIM,SR"), "GETDVLLIM,SR=([1;8])\r\nOK\r\n");
    EXPECT_NE(n.ask("$PNOR,GETDVL*27").find("SR=5.000000"), std::string::npos);
    EXPECT_EQ(n.ask("SETDEFAULT,ALL"), "OK\r\n");
    EXPECT_EQ(n.ask("GETDVL,SR"), "GETDVL,SR=4\r\nOK\r\n");
}

TEST(NortekDvl, ABreakAsksAndTimeAnswers) {
    NortekDvl n;
    EXPECT_FALSE(n.said(1s).empty());
    EXPECT_TRUE(n.ask("\x03", line, "").starts_with("NortekDVL - NORTEK AS.\r\nVersion "));
    EXPECT_EQ(n.ask("CO"), "OK\r\n");
    EXPECT_FALSE(n.said(2s).empty()) << "it goes on";
    n.ask("@@@@@@", line, "");
    n.ask("K1W%!Q", line, "");
    EXPECT_TRUE(n.said(61s).empty());
    EXPECT_FALSE(n.said(64s).empty()) << "nobody has said MC for a minute";
}

TEST(NortekDvl, PingsAtCommandsAndEdges) {
    NortekDvl by_command({{"trigger", std::string("command")}});
    EXPECT_TRUE(by_command.said(3s).empty());
    EXPECT_EQ(by_command.ask("TRIG"), "OK\r\n");
    EXPECT_EQ(by_command.ask("TRIG"), "OK\r\n") << "ignored, for one is under way";
    EXPECT_EQ(by_command.said(6s).size(), 1U);
    by_command.ask("TRIG");
    EXPECT_EQ(by_command.said(9s).size(), 1U);
    for (const auto& [trigger, count, phase] :
         {std::tuple{"rise", 12.0, 0}, {"fall", 12.0, 125}, {"edges", 24.0, 0}}) {
        NortekDvl n({{"trigger", std::string(trigger)}, {"trigger_rate", 4.0}});
        n.bottom.run(n.bench, 3s - 1ms);
        EXPECT_NEAR(static_cast<double>(n.said(n.bench.now).size()), count, 2) << trigger;
        while (!n.bench.ping) n.bottom.run(n.bench, n.bench.now + 1ms);
        EXPECT_NEAR(static_cast<double>((n.bench.now / 1ms) % 250 % (count > 20 ? 125 : 250)), phase, 1.5)
            << trigger;
    }
    NortekDvl too_fast({{"trigger", std::string("edges")}, {"trigger_rate", 50.0}});
    too_fast.bottom.altitude = 60;
    const auto frames = too_fast.said(6s).size();
    EXPECT_LT(frames, 6 * 8U) << "edges while a ping is under way are ignored";
    EXPECT_GT(frames, 6 * 3U);
    NortekDvl no_line({{"trigger", std::string("rise")}});
    EXPECT_TRUE(no_line.said(5s).empty()) << "no pulses, no pings";
}

TEST(NortekDvl, RangeAndVelocityRangeAreLimits) {
    NortekDvl n;
    n.go_to_command_mode();
    EXPECT_EQ(n.ask("SETBT,RANGE=10,VR=0.5"), "OK\r\n");
    EXPECT_EQ(n.ask("START"), "OK\r\n");
    n.bottom.altitude = 20;
    EXPECT_EQ(u32(n.last(4s), 20) & 0xF000U, 0U);
    n.bottom.altitude = 5;
    EXPECT_EQ(u32(n.last(8s), 20) & 0xF000U, 0xF000U);
    n.bottom.velocity = {1, 0, 0};
    const Bytes fast = n.last(12s);
    EXPECT_EQ(u32(fast, 20) & 0xF000U, 0U) << "faster than VR";
    EXPECT_NEAR(f32(fast, 52), 5, 0.05) << "its beams hear all the same";
}

TEST(NortekDvl, DistanceMayBeSlant) {
    NortekDvl n({{"distance", std::string("slant")}});
    EXPECT_NEAR(f32(n.last(4s), 52), 5 / std::cos(deg_to_rad(25)), 0.03);
}

TEST(NortekDvl, NoiseOnTheLineCannotWedgeIt) {
    NortekDvl n;
    std::uint32_t state = 1;
    for (int i = 0; i < 4000; ++i) {
        state = state * 1664525U + 1013904223U;
        n.bench.say(Bytes{static_cast<std::uint8_t>(state >> 24)}, line);
    }
    n.ask("");
    n.go_to_command_mode();
    EXPECT_EQ(n.ask("START"), "OK\r\n");
}

TEST(NortekDvl, EndpointsThatAreTooManyAreNamed) {
    EXPECT_THROW(make_device("nortek-dvl1000", {"pty:/tmp/a", "pty:/tmp/b"}), std::invalid_argument);
    EXPECT_THROW(make_device("nortek-dvl1000", {"udp-listen://127.0.0.1:9000"}), std::invalid_argument);
}

}  // namespace
}  // namespace echoloop::test
