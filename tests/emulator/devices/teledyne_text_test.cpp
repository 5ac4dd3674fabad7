// PD6 and PD13 of Teledyne's Doppler logs: lines as the maker's guide and published samples have them.
#include <gtest/gtest.h>

#include <cstdlib>

#include "tests/emulator/devices/teledyne_log.h"

namespace echoloop::test {
namespace {

using namespace std::chrono_literals;

/// The last report until `end`, line by line.
std::vector<std::string> last_lines(TeledyneBench& log, Time end) {
    log.bottom.run(log.bench, end);
    const auto sent = log.bench.sent();
    std::vector<std::string> lines;
    if (sent.empty()) return lines;
    const std::string text(sent.back().bytes.begin(), sent.back().bytes.end());
    std::size_t at = 0;
    for (std::size_t stop; (stop = text.find("\r\n", at)) != std::string::npos; at = stop + 2)
        lines.push_back(text.substr(at, stop - at));
    EXPECT_EQ(at, text.size()) << "a line without an end";
    return lines;
}

/// The number at that place of a line, whose head is place 0.
double number_at(const std::string& line, std::size_t place) {
    std::size_t at = 0;
    for (; place > 0; --place) at = line.find(',', at) + 1;
    return std::strtod(line.c_str() + at, nullptr);
}

std::string heads(const std::vector<std::string>& lines) {
    std::string out;
    for (const std::string& line : lines) out += line.substr(0, 3);
    return out;
}

TEST(TeledyneText, Pd6HasTheVehiclesVelocityInThreeFrames) {
    // It looks 30 deg north of east and goes 0.8 m/s ahead, 0.1 down; beam 3 looks 45 deg to starboard of
    // that.
    TeledyneBench log({{"format", std::string("pd6")}, {"heading_alignment", std::int64_t{4500}}});
    log.bottom.velocity = {0.8 * std::cos(deg_to_rad(30)), 0.8 * std::sin(deg_to_rad(30)), -0.1};
    log.bottom.orientation = lying(30 - 45);
    const auto lines = last_lines(log, 4s);
    ASSERT_EQ(heads(lines), ":SA:TS:BI:BS:BE:BD:HM") << "no water mass, no lines of it";
    EXPECT_EQ(lines[0].substr(0, 22), ":SA,   +0.00,   +0.00,") << "as wide as in a published sample";
    EXPECT_NEAR(number_at(lines[0], 3), 60, 0.05);
    EXPECT_EQ(lines[1].substr(18), ",35.0,+10.0,   0.0,1500.0,  0");
    const double along = 800 * std::sqrt(0.5);
    const std::array<double, 3> instrument{-along, along, -100}, ship{0, 800, -100},
        earth{800 * std::cos(deg_to_rad(30)), 400, -100};
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_NEAR(number_at(lines[2], i + 1), instrument[i], 3) << i;
        EXPECT_NEAR(number_at(lines[3], i + 1), ship[i], 3) << i;
        EXPECT_NEAR(number_at(lines[4], i + 1), earth[i], 3) << i;
    }
    for (const std::size_t line : {2U, 3U, 4U}) EXPECT_EQ(lines[line].back(), 'A');
    EXPECT_EQ(lines[2].size(), std::string(":BI,  +123,  -420, +2000,    +0,A").size());
    EXPECT_NEAR(number_at(lines[5], 1), 4 * earth[0] / 1000, 0.25) << "m made good to the east";
    EXPECT_NEAR(number_at(lines[5], 4), 5, 0.03) << "m to the bottom";
    EXPECT_EQ(number_at(lines[5], 5), 0) << "s since the last good velocity";
    EXPECT_EQ(lines[6], ":HM,G,D,0e8b,0ffe,*10.842,*1.974,*5.493");
    TeledyneBench other({{"format", std::string("pd6")}}, "dvl-explorer");
    EXPECT_EQ(heads(last_lines(other, 4s)), ":SA:TS:BI:BS:BE:BD") << "only a Pathfinder tells its health";
}

TEST(TeledyneText, WithoutABottomItSaysHowLongAgoItHadOne) {
    TeledyneBench log({{"format", std::string("pd6")}});
    last_lines(log, 4s);
    log.bottom.altitude = 0;
    const auto lines = last_lines(log, 14s);
    EXPECT_EQ(lines.at(2), ":BI,-32768,-32768,-32768,-32768,V") << "a published sample";
    EXPECT_EQ(lines.at(3), ":BS,-32768,-32768,-32768,V");
    EXPECT_NEAR(number_at(lines.at(5), 5), 10, 1);
    EXPECT_EQ(number_at(lines.at(5), 4), 0);
}

TEST(TeledyneText, ThreeBeamsHaveNoErrorVelocity) {
    TeledyneBench log({{"format", std::string("pd6")}});
    log.bottom.deaf = 90;
    const auto lines = last_lines(log, 4s);
    EXPECT_EQ(number_at(lines.at(2), 4), -32768);
    EXPECT_EQ(lines.at(2).back(), 'A');
}

TEST(TeledyneText, Pd13HasPressureAndRangesBesides) {
    TeledyneBench log;
    log.bottom.altitude = 8;
    log.bottom.run(log.bench, 1s);
    log.ask("===");
    EXPECT_EQ(log.ask("ED00100\r").find("ERR"), std::string::npos);
    EXPECT_EQ(log.ask("PD13\r"), "PD13\r\n>");
    log.ask("CS\r");
    const auto lines = last_lines(log, log.bench.now + 4s);
    ASSERT_EQ(heads(lines), ":SA:TS:RA:BI:BS:BE:BD:HM");
    EXPECT_NEAR(number_at(lines[2], 1), 102.5, 0.1) << "kPa 10 m down";
    for (std::size_t beam = 1; beam <= 4; ++beam) EXPECT_NEAR(number_at(lines[2], beam + 1), 80, 0.5) << "dm";
}

}  // namespace
}  // namespace echoloop::test
