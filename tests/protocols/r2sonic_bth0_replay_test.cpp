// Real bathymetry datagrams of a Sonic 2026: parsed to the numbers that are known of them, and back to the
// same bytes.
#include <gtest/gtest.h>

#include <cmath>

#include "protocols/r2sonic/beams.h"
#include "protocols/r2sonic/codec.h"
#include "tests/protocols/data.h"

namespace echoloop::r2sonic {
namespace {

constexpr const char* recording = "r2sonic/r2sonic_bth0_20.pcap";

std::vector<Bth0> parse_all(const std::vector<wire::Bytes>& datagrams) {
    std::vector<Bth0> out;
    for (const auto& bytes : datagrams) {
        auto packet = parse(bytes);
        if (!packet) throw std::runtime_error(packet.error().what());
        out.push_back(std::get<Bth0>(*std::move(packet)));
    }
    return out;
}

TEST(RealBth0, AllDatagramsAreWrittenBackByteForByte) {
    ECHOLOOP_NEED_DATA(path, recording);
    const auto datagrams = read_pcap(*path);
    ASSERT_EQ(datagrams.size(), 20U);
    for (const auto& bytes : datagrams) {
        ASSERT_EQ(bytes.size(), 1864U);
        const auto packet = parse(bytes);
        ASSERT_TRUE(packet) << packet.error().what();
        EXPECT_EQ(to_hex(serialise(*packet)), to_hex(bytes));
    }
}

TEST(RealBth0, SettingsOfThePingAreTheKnownOnes) {
    ECHOLOOP_NEED_DATA(path, recording);
    const auto packets = parse_all(read_pcap(*path));
    for (std::size_t i = 0; i < packets.size(); ++i) {
        const H0& h = packets[i].h0;
        EXPECT_EQ(h.model.view(), "2026");
        EXPECT_EQ(h.serial.view(), "100996-2026");
        EXPECT_EQ(h.points, 256);
        EXPECT_EQ(h.ping_number, packets[0].h0.ping_number + i);
        EXPECT_NEAR(h.ping_period, 0.05217, 0.00002);
        EXPECT_NEAR(h.ping_period, 2 * h.rx_range / h.sound_speed + 0.010, 5e-5);
        EXPECT_NEAR(h.rx_range, 31.948, 0.01);
        EXPECT_NEAR(h.sound_speed, 1514.96, 0.15);
        EXPECT_EQ(h.frequency, 400000.0F);
        EXPECT_EQ(h.tx_power, 206.0F);
        EXPECT_FLOAT_EQ(h.tx_pulse_width, 35e-6F);
        EXPECT_NEAR(h.tx_beam_width_vertical, 1.0 * M_PI / 180, 1e-5);
        EXPECT_NEAR(h.tx_beam_width_horizontal, 0.5 * M_PI / 180, 1e-5);
        EXPECT_NEAR(h.rx_bandwidth, 30000, 1);
        EXPECT_NEAR(h.rx_sample_rate, 65280, 0.1);
        EXPECT_EQ(h.rx_gain, 11.0F);
        EXPECT_EQ(h.rx_spreading, 15.0F);
        EXPECT_EQ(h.rx_absorption, 81.0F);
        EXPECT_EQ(h.rx_mount_tilt, 0.0F);
        EXPECT_NEAR(h.projector_temperature * 0.01, 291.75, 0.1);
        EXPECT_GE(h.vtx_offset, -26);
        EXPECT_LE(h.vtx_offset, -3);
        EXPECT_EQ(h.reserved108, 3U);
        EXPECT_EQ(h.ping_seconds / 86400, 1436399535U / 86400);  // July 2015, the day of the recording
    }
}

TEST(RealBth0, RangesAnglesAndIntensitiesAreTheKnownOnes) {
    ECHOLOOP_NEED_DATA(path, recording);
    for (const Bth0& p : parse_all(read_pcap(*path))) {
        EXPECT_FLOAT_EQ(p.r0.scale, 1.0F / (4 * 65280.0F));
        ASSERT_TRUE(std::holds_alternative<A2>(p.angles));
        const A2& a2 = std::get<A2>(p.angles);
        EXPECT_GE(a2.scale, 7.0147e-07F);
        EXPECT_LE(a2.scale, 7.0513e-07F);
        EXPECT_EQ(a2.step[0], 0);
        EXPECT_GE(a2.first, -66.0 * M_PI / 180);
        EXPECT_LE(a2.first, -58.0 * M_PI / 180);
        EXPECT_NEAR(a2.more[1], 0.119, 1e-6);
        ASSERT_TRUE(p.i1);
        EXPECT_EQ(p.i1->scale, 1.0F);
        for (const std::uint16_t intensity : p.i1->intensity) EXPECT_LE(intensity, 2493);
        EXPECT_FALSE(p.g1);
    }
}

TEST(RealBth0, PointsOnTheBottomAreEvenlySpacedAcrossTrack) {
    ECHOLOOP_NEED_DATA(path, recording);
    for (const Bth0& p : parse_all(read_pcap(*path))) {
        const auto times = two_way_times(p.r0);
        const auto angle = angles(p);
        const auto across = [&](std::size_t n) {
            return times[n] * p.h0.sound_speed / 2 * std::sin(angle[n]);
        };
        EXPECT_NEAR((across(255) - across(0)) / 255, 0.154, 0.004);
        for (std::size_t n = 1; n < 256; ++n) EXPECT_NEAR(across(n) - across(n - 1), 0.145, 0.085);
    }
}

TEST(RealBth0, QualityIsPhaseOutsideAndMagnitudeNearNadir) {
    ECHOLOOP_NEED_DATA(path, recording);
    std::size_t phase = 0;
    std::size_t all = 0;
    for (const Bth0& p : parse_all(read_pcap(*path))) {
        for (std::size_t point = 0; point < 256; ++point) {
            const std::uint8_t flags = quality_of(p.q0, point);
            ASSERT_TRUE(flags == 0xB || flags == 0x7) << int(flags);
            phase += flags == 0xB;
            ++all;
        }
        EXPECT_EQ(quality_of(p.q0, 0), 0xB);
        EXPECT_EQ(quality_of(p.q0, 128), 0x7);
    }
    EXPECT_NEAR(static_cast<double>(phase) / static_cast<double>(all), 0.58, 0.06);
}

}  // namespace
}  // namespace echoloop::r2sonic
