// The pings of a Sonic 2024: what commands make of the next one, of its bathymetry and of its image.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/emulator/devices/r2sonic_bench.h"

namespace echoloop::test {
namespace {

/// Echoes of a flat floor at `depth` m straight below: the footprint of each beam in range.
Echogram floor_echo(const Shot& shot, double depth) {
    Echogram echogram = echo_of(shot, shot.bins, 0);
    for (std::size_t beam = 0; beam < shot.bearings.size(); ++beam) {
        const double near = depth / std::cos(std::abs(shot.bearings[beam]) - shot.beam_width / 2);
        const double far = depth / std::cos(std::abs(shot.bearings[beam]) + shot.beam_width / 2);
        for (std::size_t bin = 0; bin < shot.bins; ++bin) {
            const double r = echogram.bin_range(bin), half = shot.bin_interval * 1500 / 4;
            if (r + half > near && r - half < far) echogram.values[beam * shot.bins + bin] = 1e12F;
        }
    }
    return echogram;
}

TEST(R2SonicPorts, ListensOnBasePlusTwoAndForDiscovery) {
    const auto ports = make_device("r2sonic-2024")->ports();
    ASSERT_EQ(ports.size(), 8u);
    EXPECT_EQ(ports[0].bind, (Address{0x7F000001, 65502}));
    EXPECT_EQ(ports[1].bind, (Address{0x7F000001, 53810}));
    EXPECT_EQ(ports[7].bind, (Address{0x7FFFFFFF, 53810}));
    EXPECT_TRUE(ports[1].shared && ports[7].shared);
}

TEST(R2SonicPing, RunsFreelyWithTenMillisecondsPause) {
    Bench bench = head({{"range", 30.0}});
    bench.run_to(1s);
    const auto sent = named(bench.sent(), "BTH0");
    // 2 * 30 m / 1500 m/s + 10 ms = 50 ms: transmissions at 0, 50, ... 950 ms; the answer to the last comes
    // at 992 ms
    ASSERT_EQ(sent.size(), 20u);
    EXPECT_EQ(sent[0].to, gui);
    EXPECT_EQ(u32(sent[0].bytes, 12 + 36), 1u) << "ping number";
    EXPECT_EQ(u32(sent[19].bytes, 12 + 36), 20u);
    EXPECT_NEAR(f32(sent[5].bytes, 12 + 40), 0.050, 1e-6) << "ping period";
    EXPECT_EQ(u32(sent[0].bytes, 12 + 84), 0x477F0001u) << "65280.0039 Hz, bit by bit as in real pings";
    EXPECT_EQ(u32(sent[0].bytes, 132), 0x36808080u) << "R0's scale, too";
    EXPECT_EQ(u32(sent[0].bytes, 12 + 108), 3u);
}

TEST(R2SonicPing, CommandsChangeTheNextPing) {
    Bench bench = head();
    bench.run_to(10ms);
    bench.say(command("RNG0", 50.0F));
    bench.say(command("FRQ0", 200e3F));
    bench.say(command("TXP0", 210.0F));
    bench.say(command("TXL0", 100e-6F));
    bench.say(command("GAN0", 20.0F));
    bench.say(command("SEW0", 1.0F));
    bench.say(command("SER0", 0.25F));
    bench.run_to(200ms);
    ASSERT_GE(bench.shots.size(), 2u);
    EXPECT_NEAR(bench.shots[0].frequency, 400e3, 1);
    const Shot& shot = bench.shots[1];
    EXPECT_NEAR(shot.frequency, 200e3, 1);
    EXPECT_NEAR(shot.source_level, 210, 1e-9);
    EXPECT_NEAR(shot.pulse_length, 100e-6, 1e-10);
    const double edge = 0.5 * 255 / 256;  // beams are the middles of the sector's 256 cells
    EXPECT_NEAR(shot.bearings.front(), 0.25 - edge, 1e-6);
    EXPECT_NEAR(shot.bearings.back(), 0.25 + edge, 1e-6);
    EXPECT_NEAR(shot.beam_width, deg_to_rad(1.0), 1e-9) << "twice as wide at half the frequency";
    EXPECT_GE(static_cast<double>(shot.bins) * shot.bin_interval, 2 * 50 / 1500.0);
    const auto sent = named(bench.sent(), "BTH0");
    const Bytes& last = sent.back().bytes;
    EXPECT_FLOAT_EQ(f32(last, 12 + 88), 50.0F);
    EXPECT_FLOAT_EQ(f32(last, 12 + 48), 200e3F);
    EXPECT_FLOAT_EQ(f32(last, 12 + 52), 210.0F);
    EXPECT_FLOAT_EQ(f32(last, 12 + 56), 100e-6F);
    EXPECT_FLOAT_EQ(f32(last, 12 + 92), 20.0F);
}

TEST(R2SonicPing, RateLimitTriggerAndPower) {
    Bench bench = head({{"ping_rate", 5.0}});
    bench.run_to(1s);
    EXPECT_EQ(named(bench.sent(), "BTH0").size(), 5u);
    bench.say(command("TRG0", std::uint32_t{2}));
    bench.run_to(1300ms);
    bench.sent();
    bench.run_to(3s);
    EXPECT_TRUE(named(bench.sent(), "BTH0").empty()) << "waits for PNG0";
    bench.say(command("PNG0", std::uint32_t{1}));
    bench.run_to(4s);
    EXPECT_EQ(named(bench.sent(), "BTH0").size(), 1u);
    bench.say(command("TXP0", 0.0F));
    bench.say(command("PNG0", std::uint32_t{1}));
    bench.run_to(5s);
    EXPECT_LT(bench.shots.back().source_level, -100) << "power 0 transmits nothing";
}

TEST(R2SonicPing, HostileValuesStayWithinTheManualsBounds) {
    Bench bench = head();
    for (const char* what : {"RNG0", "FRQ0", "TXL0", "SEW0", "SER0", "PRL0", "SVL0", "AIB0", "GAN0", "DGA0"})
        for (std::uint32_t raw : {0x7FC00000u, 0x7F800000u, 0xFF800000u, 0x7F7FFFFFu, 0xFF7FFFFFu, 0u})
            bench.say(command(what, raw));
    for (const char* what : {"TRG0", "AIH0", "BOS0", "PROJ", "DGO0", "SVU0", "PRU0", "RGO0"}) {
        bench.say(command(what, 0xFFFFFFFFu));
        bench.say(command("TRG0", std::uint32_t{0}));
    }
    bench.run_to(5s);
    ASSERT_FALSE(bench.shots.empty());
    for (const Shot& shot : bench.shots) {
        EXPECT_LE(shot.bins, 4096u);
        EXPECT_TRUE(std::isfinite(shot.bin_interval) && shot.bin_interval > 0);
        for (std::size_t n = 1; n < shot.bearings.size(); ++n)
            ASSERT_GT(shot.bearings[n], shot.bearings[n - 1]);
    }
    EXPECT_GT(bench.device().counters().rejected, 0u);
}

/// The manual: too great a sound velocity makes the bottom smile, since the array then looks too far inward.
TEST(R2SonicPing, AWrongSoundSpeedTurnsTheBeamsOfItsFlatArrayButNotWhatItTells) {
    Bench bench = head();
    bench.say(command("TXS0", 0.1F));
    bench.run_to(200ms);
    const Shot right = bench.shots.back();
    bench.say(command("SVL0", 1560.0F));
    bench.say(command("SVU0", std::uint32_t{1}));
    bench.run_to(400ms);
    const Shot& wrong = bench.shots.back();
    for (std::size_t n = 0; n < right.bearings.size(); ++n)
        EXPECT_NEAR(std::sin(wrong.bearings[n]), std::sin(right.bearings[n]) * 1500 / 1560, 1e-12);
    EXPECT_NEAR(right.tilt, 0.1, 1e-7);
    EXPECT_NEAR(std::sin(wrong.tilt), std::sin(0.1) * 1500 / 1560, 1e-7) << "the projector is one, too";
    const auto sent = named(bench.sent(), "BTH0");
    for (const std::size_t at : {652, 656})
        EXPECT_EQ(f32(sent.back().bytes, at), f32(sent.front().bytes, at)) << "angles of A0";
}

TEST(R2SonicPing, BeamsThatWouldLookAlongTheFaceLieNextToEachOtherBeforeIt) {
    Bench bench = head();
    bench.say(command("SEW0", static_cast<float>(deg_to_rad(160))));
    bench.say(command("SVL0", 1250.0F));
    bench.say(command("SVU0", std::uint32_t{1}));
    bench.run_to(300ms);
    const auto& bearings = bench.shots.back().bearings;
    EXPECT_GT(rad_to_deg(bearings.back()), 85);
    EXPECT_LT(rad_to_deg(bearings.back()), 90);
    EXPECT_NEAR(bearings.front(), -bearings.back(), 1e-6);
    for (std::size_t n = 1; n < bearings.size(); ++n) ASSERT_GT(bearings[n], bearings[n - 1]);
}

class R2SonicFloor : public testing::TestWithParam<bool> {};

TEST_P(R2SonicFloor, DepthsAreWithinHalfAPercentInsideSixtyDegrees) {
    Bench bench =
        head({{"range", 60.0}, {"bottom_mode", std::string(GetParam() ? "equi-distant" : "equi-angle")}});
    bench.run_to(1ms);
    ASSERT_TRUE(bench.ping);
    const auto actions = bench.device().heard(floor_echo(bench.ping->shot, 20.0), bench.ping->due);
    const auto sent = named(actions.send, "BTH0");
    ASSERT_EQ(sent.size(), 1u);
    const Bytes& b = sent[0].bytes;
    EXPECT_EQ(b.size(), u32(b, 4)) << "PacketSize";
    EXPECT_EQ(name(b, 128, 2), "R0");
    EXPECT_EQ(name(b, 648, 2), GetParam() ? "A2" : "A0");
    std::uint32_t sum = 0;
    int checked = 0;
    for (std::size_t n = 0; n < 256; ++n) {
        double angle;
        if (GetParam()) {
            sum += u16(b, 648 + 36 + 2 * n);
            angle = f32(b, 652) + static_cast<double>(f32(b, 656)) * sum;
        } else {
            angle = f32(b, 652) + (f32(b, 656) - f32(b, 652)) * static_cast<double>(n) / 255;
        }
        if (std::abs(angle) > deg_to_rad(60)) continue;
        const double range = u16(b, 136 + 2 * n) * static_cast<double>(f32(b, 132)) * 1500 / 2;
        EXPECT_NEAR(range * std::cos(angle), 20.0, 0.1) << "beam " << n << " at " << rad_to_deg(angle);
        ++checked;
    }
    EXPECT_GT(checked, 100);
    const std::size_t q0 = GetParam() ? 1196 + 16 : 648 + 36 + 16;
    EXPECT_EQ(name(b, q0, 2), "Q0");
    EXPECT_EQ(u32(b, q0 + 4) >> 28, 0xBu) << "outer beams by phase";
    EXPECT_EQ(u32(b, q0 + 4 + 16 * 4) >> 28, 0x7u) << "beams near the axis by magnitude";
}

INSTANTIATE_TEST_SUITE_P(BottomModes, R2SonicFloor, testing::Values(false, true));

TEST(R2SonicBottom, SilenceIsNoBottomAndGatesExclude) {
    Bench bench = head({{"range", 60.0}});
    bench.run_to(1ms);
    auto actions = bench.device().heard(echo_of(bench.ping->shot, 99999, 0), bench.ping->due);
    auto sent = named(actions.send, "BTH0");
    ASSERT_EQ(sent.size(), 1u);
    EXPECT_EQ(u16(sent[0].bytes, 136), 0);
    EXPECT_EQ(u32(sent[0].bytes, sent[0].bytes.size() - 128), 0u) << "no quality bit";

    Bench gated = head({{"range", 60.0}, {"trigger", std::string("command")}});
    gated.say(command("DGA0", 25.0F));
    gated.say(command("DGB0", 35.0F));
    gated.say(command("DGO0", std::uint32_t{1}));
    gated.say(command("PNG0", std::uint32_t{1}));
    gated.run_to(1ms);
    actions = gated.device().heard(floor_echo(gated.ping->shot, 20.0), gated.ping->due);
    sent = named(actions.send, "BTH0");
    EXPECT_EQ(u16(sent[0].bytes, 136 + 2 * 128), 0) << "a floor at 20 m lies outside a gate of 25..35 m";
}

TEST(R2SonicImage, DatagramsAreSmallPacedAndCoverTheImage) {
    Bench bench =
        head({{"range", 30.0}, {"image_height", std::int64_t{280}}, {"trigger", std::string("command")}});
    bench.say(command("PNG0", std::uint32_t{1}));
    bench.echo_bin = 1000;
    bench.echo_power = 1e16F;
    bench.run_to(900ms);
    const auto all = bench.sent(), sent = named(all, "AID0");
    ASSERT_GT(sent.size(), 2u);
    EXPECT_EQ(sent[0].to, (Address{gui.ip, static_cast<std::uint16_t>(gui.port + 3)}));
    EXPECT_EQ(name(sent[0].bytes, 12, 2), "H0");
    EXPECT_EQ(name(sent[0].bytes, 128, 2), "A1");
    EXPECT_EQ(u32(sent[0].bytes, 12 + 108), 0u) << "3 in bathymetry only";
    const std::uint32_t total = u32(sent[1].bytes, 12 + 16);
    EXPECT_LE(total, 280u);
    EXPECT_GT(total, 200u);
    std::uint32_t next = 0;
    for (std::size_t i = 1; i < sent.size(); ++i) {
        const Bytes& b = sent[i].bytes;
        EXPECT_LE(b.size(), 1472u);
        EXPECT_EQ(b.size(), u32(b, 4));
        EXPECT_EQ(u32(b, 12 + 4), 1u) << "ping number";
        EXPECT_EQ(u32(b, 12 + 20), next) << "first bin";
        EXPECT_EQ(u16(b, 12 + 30), 256) << "all beams";
        next += u16(b, 12 + 24);
        EXPECT_GE(sent[i].not_before, sent[i - 1].not_before);
        if (i > 13) {
            EXPECT_GE(sent[i].not_before, sent[i - 13].not_before + 3870us) << "13 at once, 0.3 ms each";
        }
    }
    EXPECT_EQ(next, total);
    const auto bathymetry = named(all, "BTH0");
    ASSERT_EQ(bathymetry.size(), 1u);
    const double after =
        to_seconds(bathymetry[0].not_before - sent[0].not_before) + 2e-3;  // s behind the range
    EXPECT_GT(after, 10.8e-3) << "as a recorded 2022 does";
    EXPECT_LT(after, 11.5e-3);
    // bin 1000 of the samples in the image: range as a reader computes it
    const double per_bin = static_cast<double>(u32(sent[1].bytes, 12 + 12)) / total;
    const auto image_bin = static_cast<std::uint32_t>(1000.5 / per_bin);
    const Bytes& hit = sent[1 + image_bin / 5].bytes;
    EXPECT_GT(hit[12 + 36 + image_bin % 5], 100);
    EXPECT_EQ(hit[12 + 36 + (image_bin + 1) % 5], 0);
}

}  // namespace
}  // namespace echoloop::test
