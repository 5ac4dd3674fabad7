// Water track of Teledyne's Doppler logs: a layer of water in place of the bottom, or beside it.
#include <gtest/gtest.h>

#include "tests/emulator/devices/teledyne_log.h"

namespace echoloop::test {
namespace {

using namespace std::chrono_literals;
using Four = std::array<int, 4>;

constexpr std::size_t layer_velocity = 50, layer_correlation = 58, layer_good = 66;  // in section 0600

/// A layer from 2 to 6 m, 1 m thick at least, in water whose echo has three times the power of the noise; 9 m
/// above the bottom, looking north, 0.5 m/s ahead, 0.2 to starboard, 0.1 down.
TeledyneBench log_with(std::int64_t mode, const std::string& format = "pd0", const Options& more = {}) {
    Options options{{"water_mode", mode},
                    {"layer_least", std::int64_t{10}},
                    {"layer_near", std::int64_t{20}},
                    {"layer_far", std::int64_t{60}},
                    {"format", format},
                    {"frame", std::string("ship")}};
    for (const auto& [name, value] : more) options[name] = value;
    TeledyneBench log(options);
    log.bottom.velocity = {0.2, 0.5, -0.1};
    log.bottom.orientation = lying(90);
    log.bottom.altitude = 9;
    log.bottom.water = 3;
    return log;
}

Four words(const Bytes& b, std::size_t at) {
    return {i16(b, at), i16(b, at + 2), i16(b, at + 4), i16(b, at + 6)};
}

void expect_near(const Four& got, const Four& wanted, int within) {
    for (std::size_t i = 0; i < got.size(); ++i) EXPECT_NEAR(got[i], wanted[i], within) << i;
}

/// Where section 0600 begins.
std::size_t bottom_section(const Bytes& ensemble) { return u16(ensemble, 6 + 2 * (ensemble.at(5) - 1U)); }

Bytes last_bytes(TeledyneBench& log, Time end) {
    log.bottom.run(log.bench, end);
    return log.bench.sent().back().bytes;
}
std::string last_text(TeledyneBench& log, Time end) {
    const Bytes bytes = last_bytes(log, end);
    return {bytes.begin(), bytes.end()};
}

TEST(TeledyneWater, LayerMovesAgainstTheLogAsTheBottomDoes) {
    auto log = log_with(1);
    const Bytes e = log.ensemble(4s);
    const std::size_t at = bottom_section(e);
    EXPECT_EQ(u16(e, at + 44), 10U);
    EXPECT_EQ(u16(e, at + 46), 20U);
    EXPECT_EQ(u16(e, at + 48), 60U);
    expect_near(words(e, at + 24), {-200, -500, 100, 0}, 2);
    expect_near(words(e, at + layer_velocity), {-200, -500, 100, 0}, 2);
    EXPECT_EQ(e[at + layer_correlation], 96) << "128 S / (S + N)";
    EXPECT_EQ(e[at + layer_good + 3], 100);
    auto off = log_with(0);
    const Bytes none = off.ensemble(4s);
    EXPECT_EQ(words(none, bottom_section(none) + layer_velocity), (Four{-32768, -32768, -32768, -32768}));
    EXPECT_EQ(u16(none, bottom_section(none) + 46), 0U);
}

TEST(TeledyneWater, Pd5HasTheVehiclesOwnSignAndItsWayInTheWater) {
    auto log = log_with(1, "pd5");
    const Bytes block = last_bytes(log, 10s);
    ASSERT_EQ(block.size(), 88U);
    expect_near(words(block, 22), {200, 500, -100, 0}, 2);
    EXPECT_EQ(u16(block, 30), 20U);
    EXPECT_EQ(u16(block, 32), 60U);
    EXPECT_EQ(block[34], 0);
    EXPECT_NEAR(i16(block, 70), 20, 2) << "dm east in 10 s";
    EXPECT_NEAR(i16(block, 74), 50, 3) << "dm north";
}

TEST(TeledyneWater, LayerEndsFourFifthsOfTheWayDownAndIsBadWhenThatIsTooThin) {
    auto log = log_with(1, "pd5");
    log.bottom.altitude = 3.6;  // 2.88 m, which is less than 1 m behind 2 m
    const Bytes block = last_bytes(log, 6s);
    EXPECT_EQ(words(block, 22), (Four{-32768, -32768, -32768, -32768}));
    EXPECT_EQ(block[34], 1 << 4) << "too shallow";
    EXPECT_NE(i16(block, 5), -32768) << "the bottom is good";
    log.bottom.altitude = 4;
    EXPECT_EQ(last_bytes(log, 12s)[34], 0);
}

TEST(TeledyneWater, OfWaterThatSendsTooLittleBackItIsBad) {
    auto log = log_with(1, "pd5");
    log.bottom.water = 0.5F;
    const Bytes block = last_bytes(log, 4s);
    EXPECT_EQ(words(block, 22), (Four{-32768, -32768, -32768, -32768}));
    EXPECT_EQ(block[34], 0x0F) << "low correlation in each beam";
}

TEST(TeledyneWater, Mode2TracksItOnlyWithoutABottom) {
    auto log = log_with(2, "pd6");
    EXPECT_EQ(last_text(log, 4s).find(":WI"), std::string::npos);
    log.bottom.altitude = 0;
    const std::string text = last_text(log, 14s);
    EXPECT_NE(text.find(":BI,-32768,-32768,-32768,-32768,V\r\n"), std::string::npos) << text;
    const auto at = text.find(":WI,  +200,  +500,  -100,");
    ASSERT_NE(at, std::string::npos) << text;
    EXPECT_LT(at, text.find(":BI")) << "in the order of the guide";
    EXPECT_NE(text.find(":WS,  +200,  +500,  -100,A\r\n"), std::string::npos) << text;
    EXPECT_NE(text.find(",   4.00,  0.00\r\n:BI"), std::string::npos)
        << "m to its middle, s since good; " << text;
}

TEST(TeledyneWater, LayerIsHeardWhateverDepthsItLooksInForTheBottom) {
    auto log = log_with(1, "pd6");
    log.bottom.altitude = 0;
    log.bottom.run(log.bench, 10s);
    const auto sent = log.bench.sent();
    ASSERT_GT(sent.size(), 20U);
    for (std::size_t i = 2; i < sent.size(); ++i) {
        const std::string text(sent[i].bytes.begin(), sent[i].bytes.end());
        EXPECT_NE(text.find(":WI,  +200,  +500,  -100,"), std::string::npos) << i << ": " << text;
    }
}

TEST(TeledyneWater, Mode3HasNoBottomTrack) {
    auto log = log_with(3, "pd6");
    log.bottom.altitude = 6;  // so near that the ping hears it
    const std::string text = last_text(log, 6s);
    EXPECT_NE(text.find(":BI,-32768,-32768,-32768,-32768,V\r\n"), std::string::npos) << text;
    EXPECT_NE(text.find(":WI,  +200,  +500,  -100,"), std::string::npos) << text;
}

TEST(TeledyneWater, ConsoleSetsModeAndLayer) {
    TeledyneBench log({{"pings_at_start", false}});
    for (const char* line : {"BK1", "#BK2", "BL10,20,60", "#BL080,0160,0240", "BL 10, 20, 60"})
        EXPECT_EQ(log.ask(std::string(line) + "\r").find("ERR"), std::string::npos) << line;
    EXPECT_NE(log.ask("BL?\r").find("10, 20, 60"), std::string::npos);
    EXPECT_NE(log.ask("BK?\r").find("BK = 2"), std::string::npos);
    for (const char* line : {"BK4", "BL80,160,239", "BL0,160,240", "BL80,160", "BL80,160,240,1", "BLA,B,C"})
        EXPECT_NE(log.ask(std::string(line) + "\r").find("ERR"), std::string::npos) << line;
    EXPECT_NE(log.ask("BL?\r").find("10, 20, 60"), std::string::npos) << "as it was";
}

}  // namespace
}  // namespace echoloop::test
