// What Nortek DVLs tell of the bottom and the water, by frames and by lines.
#include <map>
#include <numbers>
#include <tuple>

#include "emulator/devices/family/doppler/echo.h"
#include "render/water.h"
#include "tests/emulator/devices/nortek_dvl_bench.h"

namespace echoloop::test {
namespace {

using namespace nortek_dvl;
using namespace std::chrono_literals;

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
        bottom.water = 0;
        bottom.altitude = 0.4;
        EXPECT_FALSE(doppler::find_bottom_echo(bottom.hear(shot, {}), 0, settings))
            << model << " is still sending: its pulse is longer than that";
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

}  // namespace
}  // namespace echoloop::test
