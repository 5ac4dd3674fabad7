// Water column, snippets and TruePix of a Sonic, by the offsets of the R2Sonic notes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/emulator/devices/r2sonic_bench.h"
#include "tests/emulator/devices/seabed_echo.h"

namespace echoloop::test {
namespace {

constexpr std::size_t h0 = 12;  // of the first section in a datagram

/// The datagrams of one ping whose echo is that of a flat floor at 20 m, with 60 m of range.
std::vector<Send> ping_over_floor(Bench& bench) {
    bench.run_to(bench.now + 1ms);
    const Sea sea{.noise = 1e6, .echo = 1e13};
    Echogram echogram = bottom_echo(bench.ping->shot, flat(20), sea);
    return bench.device().heard(echogram, bench.ping->due).send;
}

TEST(R2SonicWaterColumn, CoversAllSamplesOfAllBeams) {
    Bench bench = head({{"range", 60.0}});
    bench.say(command("WCM0", std::uint32_t{1}));
    const auto sent = named(ping_over_floor(bench), "WCD0");
    ASSERT_GT(sent.size(), 2u);
    EXPECT_EQ(sent[0].to.port, gui.port + 5);
    EXPECT_EQ(name(sent[0].bytes, 12, 2) + name(sent[0].bytes, 128, 2), "H0A1");
    EXPECT_EQ(u16(sent[0].bytes, h0 + 114), 256) << "beams";
    const double rate = f32(sent[0].bytes, h0 + 84);
    const std::uint32_t total = u32(sent[1].bytes, 12 + 12);
    EXPECT_GE(total / rate, 2 * 60 / 1500.0) << "the whole range";
    std::uint32_t next = 0;
    std::vector<std::uint16_t> middle;
    for (std::size_t i = 1; i < sent.size(); ++i) {
        const Bytes& b = sent[i].bytes;
        const std::size_t samples = u16(b, 12 + 20);
        EXPECT_EQ(name(b, 12, 2), "M1");
        EXPECT_EQ(b.size(), u32(b, 4));
        EXPECT_EQ(b.size(), 12 + 36 + 2 * 256 * samples);
        EXPECT_EQ(u32(b, 12 + 4), 1u) << "ping";
        EXPECT_EQ(u32(b, 12 + 16), next) << "first sample";
        EXPECT_EQ(u16(b, 12 + 22), 256);
        EXPECT_EQ(u16(b, 12 + 26), 256);
        if (i > 3) {
            EXPECT_GE(sent[i].not_before, sent[i - 3].not_before + 870us) << "three at once, 0.3 ms each";
        }
        for (std::size_t s = 0; s < samples; ++s) middle.push_back(u16(b, 12 + 36 + 2 * (128 * samples + s)));
        next += static_cast<std::uint32_t>(samples);
    }
    EXPECT_EQ(next, total);
    const auto strongest =
        static_cast<double>(std::max_element(middle.begin(), middle.end()) - middle.begin());
    EXPECT_NEAR(strongest / rate * 1500 / 2, 20, 0.1);
    EXPECT_GT(*std::max_element(middle.begin(), middle.end()), 20 * middle.at(middle.size() / 4));
}

TEST(R2SonicWaterColumn, EverySampleIsInItsPlace) {
    Bench bench = head({{"range", 40.0}, {"water_column", std::string("magnitude")}});
    bench.echo_bin = 1000;
    bench.echo_power = 1e14F;
    bench.run_to(80ms);
    const auto sent = named(bench.sent(), "WCD0");
    ASSERT_GT(sent.size(), 30u);
    for (std::size_t i = 1; i < sent.size(); ++i) {
        const Bytes& b = sent[i].bytes;
        const std::size_t samples = u16(b, 12 + 20), first = u32(b, 12 + 16);
        for (std::size_t s = 0; s < samples; ++s)
            for (const std::size_t beam : {0U, 100U, 255U})
                ASSERT_EQ(u16(b, 12 + 36 + 2 * (beam * samples + s)) > 0, first + s == 1000) << first + s;
    }
}

TEST(R2SonicWaterColumn, PhaseSaysOnWhichSideOfTheBeamAnEchoLies) {
    Bench bench = head({{"range", 60.0}, {"water_column", std::string("phase")}});
    const auto sent = named(ping_over_floor(bench), "WCD0");
    const double rate = f32(sent.at(0).bytes, h0 + 84);
    const std::size_t beam = 220;  // 43 deg to starboard
    const double angle = f32(sent[0].bytes, 128 + 28 + 4 * beam);
    std::vector<int> early, late;
    for (std::size_t i = 1; i < sent.size(); ++i) {
        const Bytes& b = sent[i].bytes;
        EXPECT_EQ(name(b, 12, 2), "M2");
        const std::size_t samples = u16(b, 12 + 20), first = u32(b, 12 + 16);
        for (std::size_t s = 0; s < samples; ++s) {
            const double range = (static_cast<double>(first + s) + 0.5) / rate * 750;
            const double across = std::acos(std::min(1.0, 20 / range)) - angle;  // from the axis
            const auto phase = static_cast<std::int16_t>(u16(b, 12 + 36 + 4 * (beam * samples + s) + 2));
            if (std::abs(across + deg_to_rad(0.25)) < deg_to_rad(0.1)) early.push_back(phase);
            if (std::abs(across - deg_to_rad(0.25)) < deg_to_rad(0.1)) late.push_back(phase);
        }
    }
    ASSERT_FALSE(early.empty() || late.empty());
    for (const int phase : early) EXPECT_LT(phase, 0) << "nearer, so to port of the axis";
    for (const int phase : late) EXPECT_GT(phase, 0);
}

TEST(R2SonicSnippets, HoldTheEchoOfEachPoint) {
    Bench bench = head({{"range", 60.0}});
    bench.say(command("SNIP", std::uint32_t{1}));
    const auto all = ping_over_floor(bench);
    const auto sent = named(all, "SNI0");
    const Bytes bathymetry = named(all, "BTH0").at(0).bytes;
    ASSERT_GT(sent.size(), 1u);
    EXPECT_EQ(sent[0].to.port, gui.port + 6);
    EXPECT_EQ(u16(sent[0].bytes, h0 + 2), 140) << "H0 with more";
    EXPECT_EQ(u16(sent[0].bytes, h0 + 114), 256) << "snippets";
    const double rate = f32(sent[0].bytes, h0 + 84);
    std::size_t count = 0;
    for (std::size_t i = 0; i < sent.size(); ++i) {
        const Bytes& b = sent[i].bytes;
        EXPECT_EQ(b.size(), u32(b, 4));
        EXPECT_LE(b.size(), 1472u);
        for (std::size_t at = i == 0 ? 12 + 140 : 12; at < b.size(); at += u16(b, at + 2)) {
            ASSERT_EQ(name(b, at, 2), "S1");
            EXPECT_EQ(u32(b, at + 4), 1u) << "ping";
            const std::size_t number = u16(b, at + 8), samples = u16(b, at + 10);
            EXPECT_EQ(number, count++);
            const double begin = u32(b, at + 12) / rate, end = begin + static_cast<double>(samples) / rate;
            const double time = u16(bathymetry, 136 + 2 * number) * static_cast<double>(f32(bathymetry, 132));
            EXPECT_LT(begin, time) << number;
            EXPECT_GT(end, time) << number;
            const double angle = deg_to_rad(-60 + 120.0 * (static_cast<double>(number) + 0.5) / 256);
            EXPECT_NEAR(f32(b, at + 16), angle, 1e-4);
            EXPECT_EQ(u32(b, at + 20), 0u) << "no scale";
            EXPECT_EQ(u16(b, at + 2), 32 + (samples + 1) / 2 * 4);
        }
    }
    EXPECT_EQ(count, 256u);
}

TEST(R2SonicTruePix, TellsMagnitudeAndDirectionOfBothSides) {
    Bench bench = head({{"range", 60.0}});
    bench.say(command("TPM0", std::uint32_t{2}));
    const auto sent = named(ping_over_floor(bench), "TPX0");
    ASSERT_GT(sent.size(), 1u);
    EXPECT_EQ(sent[0].to.port, gui.port + 1);
    EXPECT_EQ(u16(sent[0].bytes, h0 + 2), 140);
    EXPECT_EQ(u32(sent[0].bytes, h0 + 108), 0u);
    EXPECT_EQ(u32(sent[0].bytes, h0 + 112), 0u);
    const double rate = f32(sent[0].bytes, h0 + 84);
    std::uint32_t next = 0;
    int checked = 0;
    for (std::size_t i = 0; i < sent.size(); ++i) {
        const Bytes& b = sent[i].bytes;
        const std::size_t d1 = i == 0 ? 12 + 140 : 12, samples = u16(b, d1 + 16);
        ASSERT_EQ(name(b, d1, 2), "D1");
        EXPECT_LE(b.size(), 1472u);
        EXPECT_EQ(u32(b, d1 + 12), next);
        EXPECT_EQ(b.size(), d1 + 56 + 8 * samples);
        const double scale = f32(b, d1 + 52);
        for (std::size_t s = 0; s < samples; ++s) {
            const double range = (next + static_cast<double>(s) + 0.5) / rate * 750;
            if (range < 22 || range > 38) continue;  // 25 to 58 deg
            const std::size_t at = d1 + 56 + 8 * s;
            const double expected = std::acos(20 / range);
            EXPECT_NEAR(static_cast<std::int16_t>(u16(b, at + 2)) * scale, -expected, deg_to_rad(2)) << range;
            EXPECT_NEAR(static_cast<std::int16_t>(u16(b, at + 6)) * scale, expected, deg_to_rad(2)) << range;
            ++checked;
        }
        next += static_cast<std::uint32_t>(samples);
    }
    EXPECT_EQ(next, u32(sent[0].bytes, 12 + 140 + 8)) << "total samples";
    EXPECT_GT(checked, 500);
}

TEST(R2SonicProducts, TellWhereTheHeadMeantToLookThoughAWrongSoundSpeedTurnsItsBeams) {
    Bench bench = head({{"range", 60.0}});
    for (const char* what : {"SNIP", "SVU0"}) bench.say(command(what, std::uint32_t{1}));
    bench.say(command("TPM0", std::uint32_t{2}));
    bench.say(command("SVL0", 1450.0F));
    const auto all = ping_over_floor(bench);
    const Bytes snippet = named(all, "SNI0").at(0).bytes;
    EXPECT_NEAR(f32(snippet, 12 + 140 + 16), deg_to_rad(-60 + 120 / 512.0), 1e-4) << "the first one's";
    const auto sent = named(all, "TPX0");
    const double rate = f32(sent.at(0).bytes, h0 + 84);
    int checked = 0;
    for (std::size_t i = 1; i < sent.size(); ++i) {
        const Bytes& b = sent[i].bytes;
        const std::size_t first = u32(b, 12 + 12), samples = u16(b, 12 + 16);
        for (std::size_t s = 0; s < samples; ++s) {
            const double range = (static_cast<double>(first + s) + 0.5) / rate * 750;
            if (range < 30 || range > 38) continue;
            const double meant = std::asin(std::sin(std::acos(20 / range)) * 1450 / 1500);
            const auto told = static_cast<std::int16_t>(u16(b, 12 + 56 + 8 * s + 6));
            EXPECT_NEAR(told * static_cast<double>(f32(b, 12 + 52)), meant, deg_to_rad(0.8)) << range;
            ++checked;
        }
    }
    EXPECT_GT(checked, 300);
}

TEST(R2SonicTruePix, GatesCutItAndTheOldHeaderHasTheVoltageOffset) {
    Bench bench(make_device("r2sonic-2026", {}, {{"range", 60.0}, {"truepix_header", std::string("v5.0")}}));
    bench.say(command("TPM0", std::uint32_t{1}));
    bench.say(command("TPG0", std::uint32_t{2}));
    bench.say(command("DGA0", 15.0F));
    bench.say(command("DGB0", 25.0F));
    bench.say(command("DGO0", std::uint32_t{1}));
    bench.run_to(200ms);  // the ping under way does not know yet
    const auto sent = named(ping_over_floor(bench), "TPX0");
    ASSERT_GT(sent.size(), 1u);
    const Bytes& b = sent[0].bytes;
    const double rate = f32(b, h0 + 84);
    EXPECT_EQ(name(b, 152, 2), "D0");
    EXPECT_NEAR(u32(b, 152 + 12) / rate, 2 * 15 / 1500.0, 2 / rate);
    const Bytes& last = sent.back().bytes;
    const double outermost = 25 / std::cos(deg_to_rad(60 - 120 / 512.0));  // m, where its gate ends
    EXPECT_NEAR((u32(last, 12 + 12) + u16(last, 12 + 16)) / rate, 2 * outermost / 1500, 2 / rate);
    EXPECT_EQ(static_cast<std::int16_t>(u16(b, h0 + 110)), static_cast<std::int16_t>(u16(b, h0 + 78)));
    EXPECT_NE(u16(b, h0 + 110), 0);
}

/// Where the image's or the water column's beams, as many as A1 has, are not silent: the first such cell.
std::vector<std::size_t> first_cells(const std::vector<Send>& sent) {
    const bool image = name(sent.at(0).bytes, 0, 4) == "AID0";
    std::vector<std::size_t> cells(256, SIZE_MAX);
    for (std::size_t i = 1; i < sent.size(); ++i) {
        const Bytes& b = sent[i].bytes;
        const std::size_t first = u32(b, 12 + (image ? 20 : 16)), count = u16(b, 12 + (image ? 24 : 20));
        EXPECT_EQ(u16(b, 12 + (image ? 26 : 22)), 256) << "total beams";
        EXPECT_EQ(u16(b, 12 + (image ? 30 : 26)), 256) << "beams";
        EXPECT_EQ(b.size(), 48 + 256 * count * (image ? 1 : 2));
        for (std::size_t at = 0; at < 256 * count; ++at)
            if ((image ? b.at(48 + at) : u16(b, 48 + 2 * at)) > 0)
                cells[at / count] = std::min(cells[at / count], first + at % count);
    }
    return cells;
}

class R2SonicUltraHighDensity : public testing::TestWithParam<std::uint32_t> {};

TEST_P(R2SonicUltraHighDensity, OfPointsLeavesImageAndWaterColumn256Beams) {
    const std::uint32_t height = GetParam();
    Bench bench = head({{"range", 60.0}, {"trigger", std::string("command")}});
    for (const auto& [what, value] : {std::pair{"UHD0", 1U}, {"AIH0", height}, {"WCM0", 1U}, {"PNG0", 1U}})
        bench.say(command(what, value));
    bench.run_to(1ms);
    Echogram echogram = echo_of(bench.ping->shot, SIZE_MAX, 0);
    for (std::size_t beam = 0; beam < 1024; ++beam)  // each has its own echo
        echogram.values.at(beam * echogram.shot.bins + 100 + beam) = 1e16F;
    const auto all = bench.device().heard(echogram, bench.ping->due).send;
    EXPECT_EQ(u16(named(all, "BTH0").at(0).bytes, h0 + 114), 1024) << "points";
    for (const char* packet : {"AID0", "WCD0"}) {
        const auto sent = named(all, packet);
        ASSERT_GT(sent.size(), 2U);
        const Bytes& first = sent[0].bytes;
        EXPECT_EQ(u16(first, h0 + 114), 256) << "beams";
        ASSERT_EQ(first.size(), 128U + 28 + 4 * 256);
        const auto cells = first_cells(sent);
        const bool image = packet == std::string("AID0");
        const std::size_t bins = image ? (echogram.shot.bins + height - 1) / height : 1;  // in a cell
        for (std::size_t n = 0; n < 256; ++n) {
            const double beam = std::round(static_cast<double>(n) * 1023 / 255);
            EXPECT_NEAR(rad_to_deg(f32(first, 128 + 28 + 4 * n)), -60 + 120 * (beam + 0.5) / 1024, 1e-4);
            EXPECT_EQ(cells[n], (100 + static_cast<std::size_t>(beam)) / bins) << packet << ' ' << n;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(ImageHeights, R2SonicUltraHighDensity, testing::Values(600, 4096));

TEST(R2SonicProducts, AreSilentUnlessAskedForAndNeverOutlastThePing) {
    Bench bench = head({{"range", 60.0}});
    const auto quiet = ping_over_floor(bench);
    ASSERT_EQ(quiet.size(), 1u);
    EXPECT_EQ(name(quiet[0].bytes, 0, 4), "BTH0");
    Bench all = head({{"range", 15.0}, {"image_height", std::int64_t{2000}}, {"datagram_gap", 0.01}});
    for (const char* what : {"WCM0", "TPM0", "SNIP"}) all.say(command(what, std::uint32_t{1}));
    const auto sent = ping_over_floor(all);
    EXPECT_GT(sent.size(), 200u);
    EXPECT_LT(sent.back().not_before - sent.at(1).not_before, 30ms) << "the period is 20 + 10 ms";
}

TEST(R2SonicImage, CanBeWrittenBinByBin) {
    Bench bench =
        head({{"range", 60.0}, {"image_height", std::int64_t{500}}, {"image_order", std::string("bins")}});
    Bench usual = head({{"range", 60.0}, {"image_height", std::int64_t{500}}});
    const auto turned = named(ping_over_floor(bench), "AID0"), plain = named(ping_over_floor(usual), "AID0");
    ASSERT_EQ(turned.size(), plain.size());
    for (std::size_t i = 1; i < plain.size(); ++i) {
        const std::size_t bins = u16(plain[i].bytes, 12 + 24);
        for (std::size_t beam = 0; beam < 256; ++beam)
            for (std::size_t bin = 0; bin < bins; ++bin)
                ASSERT_EQ(turned[i].bytes.at(48 + bin * 256 + beam),
                          plain[i].bytes.at(48 + beam * bins + bin));
    }
}

}  // namespace
}  // namespace echoloop::test
