// Pictures that are read back from messages: what comes in parts, and what no device of ours sends.
#include "tools/said/said.h"

#include <gtest/gtest.h>

#include <cmath>

#include "protocols/edgetech/codec.h"
#include "protocols/inspect.h"
#include "protocols/r2sonic/codec.h"

namespace echoloop::said {
namespace {

/// All pictures that a family's makers see in messages that the sonar has sent.
std::vector<Picture> pictures_of(Maker& maker, std::string_view family, const wire::Bytes& bytes) {
    std::vector<Picture> all;
    for (const auto& message : inspect::find_family(family)->decode(bytes)) {
        const wire::ByteView own = wire::ByteView(bytes).subspan(message.offset, message.size);
        EXPECT_EQ(message.reason, "");
        for (auto picture = maker.take(message, own, true); picture; picture = maker.also())
            all.push_back(*picture);
    }
    return all;
}

constexpr float db(double amplitude) { return static_cast<float>(20 * std::log10(amplitude)); }

/// Type 82: samples of 5 us and so 3.75 mm each, times 2^-2 V.
wire::Bytes old_side(std::uint8_t channel, std::uint32_t ping, std::uint16_t value) {
    edgetech::OldSideScan old;
    old.ping = ping;
    old.samples = 3;
    old.interval = 5000;
    old.first_sample = 100;
    old.weighting = 2;
    old.data = {static_cast<std::uint8_t>(value), static_cast<std::uint8_t>(value >> 8), 0, 0, 8, 0};
    edgetech::Header header;
    header.type = edgetech::Type::old_side_scan;
    header.subsystem = edgetech::high_frequency;
    header.channel = channel;
    return edgetech::encode({header, old});
}

TEST(SaidPictures, OfAnOlderSideScanAreBothSidesOfAPing) {
    const auto maker = maker_of("edgetech");
    EXPECT_TRUE(pictures_of(*maker, "edgetech", old_side(0, 7, 4000)).empty());
    const auto all = pictures_of(*maker, "edgetech", old_side(1, 7, 400));
    ASSERT_EQ(all.size(), 1U);
    const Picture& one = all[0];
    EXPECT_EQ(one.name, "OldSideScan high");
    EXPECT_TRUE(one.waterfall && one.assumed);
    EXPECT_EQ(one.bins, 3U);
    EXPECT_NEAR(one.bin_size, 3.75e-3, 1e-9);
    EXPECT_NEAR(one.first_range, 0.375, 1e-9);
    ASSERT_EQ(one.levels.size(), 6U);
    EXPECT_FLOAT_EQ(one.levels[0], db(1000));
    EXPECT_FLOAT_EQ(one.levels[3], db(100));
    EXPECT_FLOAT_EQ(one.levels[5], db(2));
    EXPECT_TRUE(std::isnan(one.levels[1])) << "0 is nothing";
}

TEST(SaidPictures, OfAnOlderSideScanAreNoneWhereSizesContradict) {
    const auto maker = maker_of("edgetech");
    wire::Bytes bytes = old_side(0, 7, 4000);
    constexpr std::size_t samples_at = 16 + 12;
    bytes[samples_at] = 4;
    EXPECT_TRUE(pictures_of(*maker, "edgetech", bytes).empty());
    EXPECT_TRUE(pictures_of(*maker, "edgetech", old_side(1, 8, 4000)).empty());
}

TEST(SaidPictures, OfASubBottomProfilerAreALineThatLooksDown) {
    edgetech::SonarData data;
    data.format = edgetech::DataFormat::analytic;
    data.interval = 20'000;
    data.sound_speed = 1480;
    data.data = {3, 0, 4, 0, 0, 0, 0, 0};
    edgetech::set_sample_count(data, 2);
    edgetech::Header header;
    header.subsystem = 0;
    const auto maker = maker_of("edgetech");
    const auto all = pictures_of(*maker, "edgetech", edgetech::encode({header, data}));
    ASSERT_EQ(all.size(), 1U);
    EXPECT_EQ(all[0].name, "SonarData sub-bottom");
    EXPECT_EQ(all[0].bearings, std::vector<double>{0});
    EXPECT_TRUE(all[0].down && !all[0].waterfall);
    EXPECT_NEAR(all[0].bin_size, 740 * 20e-6, 1e-9);
    EXPECT_FLOAT_EQ(all[0].levels[0], db(5));
}

/// A datagram of one ping's snippets, of 10 mm a sample; its number is that of the angle's degrees.
wire::Bytes snippets(std::uint32_t ping, bool first, std::vector<std::uint16_t> degrees) {
    r2sonic::Sni0 packet;
    if (first) {
        packet.h0 = r2sonic::LongH0{};
        packet.h0->settings.ping_number = ping;
        packet.h0->settings.sound_speed = 1500;
        packet.h0->settings.rx_sample_rate = 75'000;
        packet.h0->settings.points = 10;
    }
    for (const std::uint16_t at : degrees) {
        r2sonic::S1 one;
        one.ping_number = ping;
        one.snippet = at;
        one.samples = 2;
        one.first_sample = 800U + at;
        one.angle = static_cast<float>(at * 0.01);
        one.magnitude = {100, static_cast<std::uint16_t>(ping * 10)};
        if (at == degrees.front())
            packet.s1 = one;
        else
            packet.others.push_back(one);
    }
    return r2sonic::serialise(packet);
}

TEST(SaidPictures, OfSnippetsAreThoseOfAPingEachAtItsRange) {
    const auto maker = maker_of("r2sonic");
    EXPECT_TRUE(pictures_of(*maker, "r2sonic", snippets(5, true, {1, 2})).empty());
    const auto all = pictures_of(*maker, "r2sonic", snippets(5, false, {4, 9}));
    ASSERT_EQ(all.size(), 1U) << "point 9 is the last";
    const Picture& one = all[0];
    EXPECT_EQ(one.name, "SNI0");
    ASSERT_EQ(one.bearings.size(), 4U);
    EXPECT_NEAR(one.bearings[3], 0.09, 1e-6);
    EXPECT_NEAR(one.bin_size, 0.01, 1e-9);
    const auto level = [&](std::size_t beam, std::size_t bin) { return one.levels[beam * one.bins + bin]; };
    EXPECT_FLOAT_EQ(level(2, 804), db(100));
    EXPECT_FLOAT_EQ(level(2, 805), db(50));
    EXPECT_TRUE(std::isnan(level(2, 803)) && std::isnan(level(2, 806)));
}

TEST(SaidPictures, OfSnippetsAreWholeWithTheNextPingWhereTheLastPointHasNone) {
    const auto maker = maker_of("r2sonic");
    EXPECT_TRUE(pictures_of(*maker, "r2sonic", snippets(5, true, {1, 2})).empty());
    auto all = pictures_of(*maker, "r2sonic", snippets(6, true, {1, 2, 3}));
    ASSERT_EQ(all.size(), 1U);
    EXPECT_EQ(all[0].bearings.size(), 2U);
    all = pictures_of(*maker, "r2sonic", snippets(7, true, {4, 9}));
    ASSERT_EQ(all.size(), 2U) << "the one before, and one that is whole at once";
    EXPECT_EQ(all[0].bearings.size(), 3U);
    EXPECT_EQ(all[1].bearings.size(), 2U);
}

TEST(SaidPictures, OfSnippetsAreNoneOfAPingWhoseRestWasSkipped) {
    const auto maker = maker_of("r2sonic");
    EXPECT_TRUE(pictures_of(*maker, "r2sonic", snippets(5, true, {1, 2})).empty());
    maker->skipped("SNI0");
    EXPECT_TRUE(pictures_of(*maker, "r2sonic", snippets(9, false, {3})).empty())
        << "of a ping without its head";
    EXPECT_TRUE(pictures_of(*maker, "r2sonic", snippets(10, true, {1, 2})).empty());
}

}  // namespace
}  // namespace echoloop::said
