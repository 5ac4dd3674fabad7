// Teledyne's Doppler logs on the bench: ensembles are read at the offsets of the makers' guides, never by the
// project's codec.
#include <gtest/gtest.h>

#include <array>

#include "tests/emulator/devices/teledyne_log.h"

namespace echoloop::test {
namespace {

using namespace std::chrono_literals;
using Log = TeledyneBench;

/// Where the section with that id begins; 0: there is none.
std::size_t section(const Bytes& ensemble, unsigned id) {
    for (std::size_t i = 0; i < ensemble.at(5); ++i)
        if (u16(ensemble, u16(ensemble, 6 + 2 * i)) == id) return u16(ensemble, 6 + 2 * i);
    return 0;
}

std::array<int, 4> velocities(const Bytes& ensemble) {
    const std::size_t at = section(ensemble, 0x0600) + 24;
    return {i16(ensemble, at), i16(ensemble, at + 2), i16(ensemble, at + 4), i16(ensemble, at + 6)};
}

TEST(TeledyneLog, EnsembleHasTheSizesOfItsSeries) {
    for (const auto& [model, fixed, variable, bottom] : {std::tuple{"dvl-pathfinder", 58U, 77U, 81U},
                                                         {"dvl-explorer", 58U, 60U, 81U},
                                                         {"dvl-navigator", 59U, 65U, 85U}}) {
        Log log({}, model);
        const Bytes e = log.ensemble(2s);
        ASSERT_FALSE(e.empty()) << model;
        EXPECT_EQ(e[5], 3);
        EXPECT_EQ(section(e, 0x0080) - 12, fixed) << model;
        EXPECT_EQ(section(e, 0x0600) - section(e, 0x0080), variable) << model;
        EXPECT_EQ(e.size() - 2 - section(e, 0x0600), bottom) << model;
        EXPECT_EQ(u16(e, 12 + 4) & 0xF000, 0x4000U) << "Janus of four";
        EXPECT_EQ(u16(e, 12 + 4) & 0x0307, 0x0203U) << "30 deg, 600 kHz";
    }
}

TEST(TeledyneLog, BottomMovesAgainstTheVehicleInEveryFrame) {
    // A vehicle that looks north and goes 0.5 m/s ahead, 0.2 to starboard, 0.1 down.
    const Vec3 motion{0.2, 0.5, -0.1};
    const double b = 1000 * std::sin(deg_to_rad(30)), c = 1000 * std::cos(deg_to_rad(30));
    const auto whole = [](double v) { return static_cast<int>(std::lround(v)); };
    const std::array<int, 4> beams{whole(-0.2 * b + 0.1 * c), whole(0.2 * b + 0.1 * c),
                                   whole(0.5 * b + 0.1 * c), whole(-0.5 * b + 0.1 * c)};
    for (const auto& [frame, wanted] : {std::pair{"beam", beams},
                                        {"instrument", std::array{-200, -500, 100, 0}},
                                        {"ship", {-200, -500, 100, 0}},
                                        {"earth", {-200, -500, 100, 0}}}) {
        Log log({{"frame", std::string(frame)}});
        log.bottom.velocity = motion;
        log.bottom.orientation = lying(90);
        const auto got = velocities(log.ensemble(3s));
        for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(got[i], wanted[i], 2) << frame << ' ' << i;
    }
}

TEST(TeledyneLog, AlignmentTurnsFromTheLogToTheShip) {
    // The log is turned by 45 deg to starboard in a ship that looks east and goes ahead.
    Log log({{"heading_alignment", std::int64_t{4500}}, {"frame", std::string("ship")}});
    log.bottom.velocity = {0.8, 0, 0};
    log.bottom.orientation = lying(-45);
    const Bytes e = log.ensemble(3s);
    const auto got = velocities(e);
    EXPECT_NEAR(got[0], 0, 2);
    EXPECT_NEAR(got[1], -800, 2);
    EXPECT_NEAR(u16(e, section(e, 0x0080) + 18), 9000, 2) << "the ship's heading";
    log.ask("EX01111\r");
    log.ask("CS\r");
    const auto own = velocities(log.ensemble(log.bench.now + 3s));
    EXPECT_NEAR(own[0], 566, 2) << "in its own axes";
    EXPECT_NEAR(own[1], -566, 2);
}

TEST(TeledyneLog, TiltsLevelTheVelocityAndAreTold) {
    Log log({{"frame", std::string("earth")}});
    log.bottom.velocity = {0, 1, 0};
    log.bottom.orientation = lying(90, 12, 8);
    const Bytes e = log.ensemble(3s);
    const auto got = velocities(e);
    EXPECT_NEAR(got[0], 0, 3);
    EXPECT_NEAR(got[1], -1000, 3);
    EXPECT_NEAR(got[2], 0, 3);
    const double roll = 0.01 * i16(e, section(e, 0x0080) + 22), tilt = 0.01 * i16(e, section(e, 0x0080) + 20);
    EXPECT_NEAR(roll, 8, 0.02);
    EXPECT_NEAR(rad_to_deg(std::atan(std::tan(deg_to_rad(tilt)) * std::cos(deg_to_rad(roll)))), 12, 0.02)
        << "pitch, by Teledyne's booklet of coordinate transformation";
}

TEST(TeledyneLog, RangesAreVertical) {
    for (const double altitude : {0.6, 3.0, 9.0, 25.0, 70.0}) {
        Log log;
        log.bottom.altitude = altitude;
        const Bytes e = log.ensemble(15s);
        for (std::size_t beam = 0; beam < 4; ++beam)
            EXPECT_NEAR(0.01 * u16(e, section(e, 0x0600) + 16 + 2 * beam), altitude,
                        0.005 * altitude + 0.006);
    }
}

TEST(TeledyneLog, PortIsNotStarboard) {
    for (const auto& [bearing, beam] : {std::pair{-90.0, 0U}, {90.0, 1U}, {0.0, 2U}, {-180.0, 3U}}) {
        Log log({{"frame", std::string("beam")}});
        log.bottom.deaf = bearing;
        const Bytes e = log.ensemble(3s);
        const auto got = velocities(e);
        for (std::size_t i = 0; i < 4; ++i) {
            EXPECT_EQ(got[i] == -32768, i == beam) << bearing;
            EXPECT_EQ(u16(e, section(e, 0x0600) + 16 + 2 * i) == 0, i == beam);
        }
        Log three;
        three.bottom.deaf = bearing;
        EXPECT_EQ(velocities(three.ensemble(3s))[3], -32768) << "three beams have no error velocity";
        EXPECT_NE(velocities(three.ensemble(6s))[0], -32768);
    }
}

TEST(TeledyneLog, WithoutABottomVelocitiesAreBadAndPingsSlow) {
    Log log;
    log.bottom.altitude = 0;
    const Bytes e = log.ensemble(5s);
    EXPECT_EQ(velocities(e), (std::array{-32768, -32768, -32768, -32768}));
    for (std::size_t beam = 0; beam < 4; ++beam) EXPECT_EQ(u16(e, section(e, 0x0600) + 16 + 2 * beam), 0U);
}

TEST(TeledyneLog, PingsAsOftenAsTheAltitudeAllows) {
    Log log;
    log.bottom.altitude = 8;
    const unsigned before = u16(log.ensemble(5s), 70 + 2), after = u16(log.ensemble(15s), 70 + 2);
    EXPECT_NEAR(after - before, 10 / (0.03 + 4.2e-3 * 8), 5);
    Log slow;
    slow.ask("TP00:00.50\r");
    slow.ask("CS\r");
    const unsigned first = u16(slow.ensemble(5s), 70 + 2);
    EXPECT_NEAR(u16(slow.ensemble(15s), 70 + 2) - first, 20, 1);
}

TEST(TeledyneLog, ConsoleAnswersAsTheGuideHasIt) {
    Log log;
    log.heard(2s);
    const std::string wake = log.ask("===");
    EXPECT_NE(wake.find("Pathfinder\r\nTeledyne RD Instruments (c) 2017\r\nAll rights reserved.\r\n"
                        "Firmware Version: 67.01\r\n"),
              std::string::npos)
        << wake;
    EXPECT_TRUE(wake.ends_with("\r\n>")) << wake;
    EXPECT_EQ(log.heard(6s).size(), 0U) << "it does not ping";
    EXPECT_EQ(log.ask("\n"), "\r\n>") << "a public driver waits for a prompt behind a bare line end";
    EXPECT_EQ(log.ask("EX00000\r"), "EX00000\r\n>");
    EXPECT_EQ(log.ask("BPA\r\n"), "BPA ERR: Bad command parameters!\r\n>");
    for (const char* line : {"CR1",
                             "CB811",
                             "CF11110",
                             "BP1",
                             "BX00600",
                             "EA+04500",
                             "ED00000",
                             "ES35",
                             "EC1480",
                             "EZ11011010",
                             "TE00:00:00.00",
                             "TP00:00.05",
                             "TS26/11/27,12:30:15",
                             "WP1",
                             "WN40",
                             "WS0200",
                             "PD0",
                             "#PD0",
                             "CK",
                             "PS0",
                             "PA",
                             "?",
                             "BX?",
                             "TS?"})
        EXPECT_EQ(log.ask(std::string(line) + "\r").find("ERR"), std::string::npos) << line;
    for (const char* line :
         {"QQ", "EX2", "BX9", "PD99", "TS26/13/27,12:30:15", "WN0", "EC99999999999999", "TP1:1"})
        EXPECT_NE(log.ask(std::string(line) + "\r").find("ERR"), std::string::npos) << line;
    EXPECT_EQ(log.ask("BX?\r").find('}'), std::string::npos) << "a public host hunts for 7D";
    EXPECT_EQ(log.ask("CS\r").find('>'), std::string::npos) << "no prompt";
    const Bytes e = log.ensemble(log.bench.now + 2s);
    ASSERT_FALSE(e.empty());
    EXPECT_EQ(e[section(e, 0x0000) + 9], 40) << "cells";
    EXPECT_EQ(u16(e, section(e, 0x0600) + 70), 600U);
    EXPECT_EQ(e[section(e, 0x0080) + 4], 26);
    EXPECT_EQ(e[section(e, 0x0080) + 7], 12) << "its clock was set";
    EXPECT_EQ(i16(e, section(e, 0x0000) + 26), 4500);
}

TEST(TeledyneLog, InputWhilePingingIsABreakUnlessTheOptionSaysNo) {
    Log log;
    log.heard(2s);
    const std::string said = log.ask("PD5\r");
    EXPECT_NE(said.find("Firmware Version"), std::string::npos);
    EXPECT_TRUE(said.ends_with("PD5\r\n>")) << said;
    Log strict({{"input_is_break", false}});
    strict.heard(2s);
    EXPECT_EQ(strict.ask("PD5\r"), "");
    EXPECT_NE(strict.ask("+++").find('>'), std::string::npos);
}

TEST(TeledyneLog, WaitsForALineEndWhenAutoPingIsOff) {
    Log log({{"pings_at_start", false}});
    log.ask("CF10110\r");
    EXPECT_TRUE(log.ask("CS\r").ends_with("<"));
    EXPECT_EQ(log.heard(5s).size(), 0U);
    log.ask("\r");
    const Bytes said = log.heard(10s);
    EXPECT_EQ(std::count(said.begin(), said.end(), '<'), 1);
    EXPECT_EQ(said.at(0), 0x7F);
}

TEST(TeledyneLog, Pd4AndPd5HaveTheVehiclesOwnSign) {
    for (const auto& [format, size, structure] : {std::tuple{"pd4", 47U, 0}, {"pd5", 88U, 1}}) {
        Log log({{"format", std::string(format)}, {"frame", std::string("ship")}});
        log.bottom.velocity = {0.2, 0.5, -0.1};
        log.bottom.orientation = lying(90);
        log.bottom.run(log.bench, 3s);
        const Bytes block = log.bench.sent().back().bytes;
        ASSERT_EQ(block.size(), size);
        EXPECT_EQ(block[0], 0x7D);
        EXPECT_EQ(block[1], structure);
        EXPECT_EQ(u16(block, 2), size - 2);
        EXPECT_EQ(block[4] >> 6, 2) << "ship";
        EXPECT_NEAR(i16(block, 5), 200, 2);
        EXPECT_NEAR(i16(block, 7), 500, 2);
        EXPECT_NEAR(i16(block, 9), -100, 2);
        EXPECT_NEAR(u16(block, 13), 500, 3);
        if (structure != 1) continue;
        EXPECT_EQ(u16(block, 52), 0U) << "north";
        EXPECT_NEAR(i16(block, 54), 6, 1) << "dm east in 3 s";
        EXPECT_NEAR(i16(block, 58), 15, 1) << "dm north";
    }
}

TEST(TeledyneLog, WaterMovesAsTheVehicleDoes) {
    Log log({{"profile_pings", std::int64_t{1}}, {"profile_cells", std::int64_t{5}}});
    log.bottom.velocity = {0.2, 0.5, 0};
    log.bottom.orientation = lying(90);
    const Bytes e = log.ensemble(3s);
    const std::size_t at = section(e, 0x0100);
    ASSERT_NE(at, 0U);
    EXPECT_EQ(section(e, 0x0200) - at, 2 + 8 * 5U);
    EXPECT_EQ(section(e, 0x0300) - section(e, 0x0200), 2 + 4 * 5U);
    // The bench's water is silent but where the bottom lies, 5 m below: the third cell of 2 m behind 0.88 m.
    EXPECT_NEAR(i16(e, at + 2 + 8 * 2), -200, 3);
    EXPECT_NEAR(i16(e, at + 2 + 8 * 2 + 2), -500, 3);
    EXPECT_EQ(e[section(e, 0x0400) + 2 + 4 * 2 + 3], 100);
    EXPECT_EQ(i16(e, at + 2), -32768);
}

TEST(TeledyneLog, NoiseOnTheLineCannotWedgeIt) {
    Bench bench(make_device("dvl-pathfinder"));
    std::uint32_t state = 1;
    for (int i = 0; i < 4000; ++i) {
        state = state * 1664525U + 1013904223U;
        bench.say(Bytes{static_cast<std::uint8_t>(state >> 24)});
    }
    bench.sent();
    for (const char c : std::string("\r===")) bench.say(Bytes{static_cast<std::uint8_t>(c)});
    std::string said;
    for (const Send& send : bench.sent()) said += std::string(send.bytes.begin(), send.bytes.end());
    EXPECT_TRUE(said.ends_with(">"));
}

}  // namespace
}  // namespace echoloop::test
