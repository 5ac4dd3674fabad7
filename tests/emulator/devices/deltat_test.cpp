// What a Delta T's program sends by itself: the 83P header, depths of a flat floor and a slope, its pace.
#include <bit>

#include "tests/emulator/devices/deltat_bench.h"

namespace echoloop::test {
namespace {

TEST(DeltaT, SpeaksFirstAndToItsHost) {
    Bench bench = delta_t();
    const auto ports = bench.device().ports();
    ASSERT_EQ(ports.size(), 1U);
    EXPECT_EQ(ports[0].kind, Port::Kind::datagram);
    EXPECT_EQ(ports[0].bind.ip, 0x7F000001U);
    bench.run_to(100ms);
    const auto sent = bench.sent();
    ASSERT_FALSE(sent.empty());
    EXPECT_EQ(sent[0].to.ip, 0x7F000001U);
    EXPECT_EQ(sent[0].to.port, 4040);
}

TEST(DeltaT, TheHeaderIsThatOfTheSpecification) {
    const Model& row = *find_model("imagenex-deltat");
    DeviceConfig config = make_config(row);
    config.unix_start = 1795298707.125;  // 2026-11-21 22:05:07.125 UTC
    config.sound_speed = 1482.3;
    Bench bench(row.make(config));
    const Bytes b = next_83p(bench);
    ASSERT_EQ(b.size(), 256U + 4 * 240);
    EXPECT_EQ(text_at(b, 0, 3), "83P");
    EXPECT_EQ(b[3], 10);
    EXPECT_EQ(be(b, 4), b.size());
    EXPECT_EQ(text_at(b, 8, 12), std::string("21-NOV-2026\0", 12));
    EXPECT_EQ(text_at(b, 20, 9), std::string("22:05:07\0", 9));
    EXPECT_EQ(text_at(b, 29, 4), std::string(".12\0", 4));
    EXPECT_EQ(text_at(b, 112, 5), std::string(".125\0", 5));
    EXPECT_EQ(be(b, 70), 240U);
    EXPECT_EQ(be(b, 72), 5000U);
    EXPECT_EQ(be(b, 74), 120U);
    EXPECT_EQ(be(b, 76), 12000U) << "-60 deg";
    EXPECT_EQ(b[78], 50);
    EXPECT_EQ(be(b, 79), 20U);
    EXPECT_EQ(be(b, 81), 260U);
    EXPECT_EQ(be(b, 83), 0x8000U | 14823);
    EXPECT_EQ(be(b, 85), 4U) << "mm";
    EXPECT_EQ(be(b, 89), 180U);
    EXPECT_EQ(be(b, 91), 50U) << "ms, at most 20 pings a second";
    EXPECT_EQ(be(b, 93, 4), 1U);
    EXPECT_EQ(be(b, 120), 367U) << "2R/c and 10 ms, in 100 us";
    EXPECT_EQ(b[117], 1);
    EXPECT_EQ(b[122], 1);
    EXPECT_EQ(b[125], 0);
    EXPECT_EQ(b[137], 0);
    for (std::size_t at = 155; at < 256; ++at) EXPECT_EQ(b[at], 0) << at;
}

TEST(DeltaT, SilenceIsNoBottomAndNoIntensity) {
    Bench bench = delta_t();
    const Bytes b = next_83p(bench);
    for (std::size_t n = 0; n < 480; ++n) EXPECT_EQ(be(b, 256 + 2 * n), 0U) << n;
}

/// The 83P of the ping under way whose echo is this bottom's.
Bytes heard_over(Bench& bench, const Bottom& bottom) {
    while (!bench.ping) bench.run_to(bench.now + 1ms);
    Shot shot = bench.ping->shot;
    Sea sea;
    sea.speckle = false;
    Echogram echogram = empty_sea(shot, sea);
    echogram.shot.receiver.bandwidth = 1 / shot.pulse_length;
    add_bottom(echogram, bottom, sea);
    echogram.shot = shot;
    const Time due = bench.ping->due;
    return bench.device().heard(echogram, due).send.at(0).bytes;
}

void expect_depths(const Bytes& b, const Bottom& bottom) {
    std::size_t inside = 0;
    for (std::size_t n = 0; n < be(b, 70); ++n) {
        const double angle = angle_of(b, n);
        if (std::abs(angle) >= deg_to_rad(60) - 1e-9) continue;
        ++inside;
        const double depth = range_of(b, n) * std::cos(angle), true_depth = bottom(angle) * std::cos(angle);
        EXPECT_NEAR(depth, true_depth, 0.005 * true_depth) << rad_to_deg(angle) << " deg";
        EXPECT_GT(be(b, 256 + 2 * be(b, 70) + 2 * n), 0U) << "hosts skip beams without intensity";
    }
    EXPECT_GT(inside, be(b, 70) - 3);
}

TEST(DeltaT, FlatFloorsAndSlopesAreWhereTheyAreToHalfAPercent) {
    for (const Bottom& bottom : {flat(8), flat(5), sloping(7, deg_to_rad(10)), sloping(7, deg_to_rad(-10))}) {
        Bench bench = delta_t({{"range", std::string("30")}});
        expect_depths(heard_over(bench, bottom), bottom);
    }
}

TEST(DeltaT, SmoothingKeepsAStepAndIsAnOption) {
    const Bottom bottom = step(8, 1.5, 1.2);
    Bench bench = delta_t(), alone = delta_t({{"smoothing", 0.0}});
    const Bytes b = heard_over(bench, bottom), c = heard_over(alone, bottom);
    EXPECT_NE(b, c);
    for (std::size_t n = 0; n < 240; ++n) {
        const double angle = angle_of(b, n), depth = range_of(b, n) * std::cos(angle);
        if (angle > deg_to_rad(16) && angle < deg_to_rad(50)) {
            EXPECT_NEAR(depth, 6.5, 0.065) << n;
        }
        if (angle < deg_to_rad(3) && angle > deg_to_rad(-50)) {
            EXPECT_NEAR(depth, 8, 0.08) << n;
        }
    }
}

TEST(DeltaT, BeamsGoFromPortToStarboard) {
    Bench bench = delta_t();
    const Bytes b = heard_over(bench, sloping(7, deg_to_rad(10)));  // shallower to starboard
    EXPECT_LT(range_of(b, 200) * std::cos(angle_of(b, 200)), 6.5);
    EXPECT_GT(range_of(b, 40) * std::cos(angle_of(b, 40)), 7.5);
    EXPECT_LT(angle_of(b, 0), 0);
}

TEST(DeltaT, WhatLiesBeyondTheRangeIsNoBottom) {
    Bench bench = delta_t({{"range", std::string("10")}});
    const Bytes b = heard_over(bench, flat(8));
    const double edge = std::acos(8 / 10.0);
    std::size_t found = 0;
    for (std::size_t n = 0; n < 240; ++n) {
        const bool seen = range_of(b, n) > 0;
        EXPECT_FALSE(seen && std::abs(angle_of(b, n)) > edge + deg_to_rad(1)) << n;
        if (seen) ++found;
    }
    EXPECT_GT(found, 100U);
}

TEST(DeltaT, TheRangeMakesThePace) {
    for (const auto& [range, period] : {std::pair{"5", 50.0}, {"30", 50.0}, {"60", 90.0}, {"300", 410.0}}) {
        Bench bench = delta_t({{"range", std::string(range)}});
        const Bytes first = next_83p(bench);
        const Time at = bench.now;
        const Bytes second = next_83p(bench);
        EXPECT_NEAR(to_seconds(bench.now - at), period / 1000, 2e-3) << range;
        EXPECT_EQ(be(first, 91), period);
        EXPECT_EQ(be(second, 93, 4), be(first, 93, 4) + 1);
    }
}

TEST(DeltaT, AttitudeIsThatOfTheHead) {
    Bench bench = delta_t();
    bench.run_to(bench.now);
    while (!bench.ping) bench.run_to(bench.now + 1ms);
    Echogram echogram = echo_of(bench.ping->shot, 0, 0);
    // A vehicle that heads 20 deg west of north, port side up by 3 deg; a bow down by 5 deg is a positive
    // pitch in FLU.
    const Quat body = from_rpy(deg_to_rad(3), deg_to_rad(5), deg_to_rad(110));
    echogram.world_from_sonar.orientation = body * from_rpy(0, deg_to_rad(90), 0);
    const Bytes b = bench.device().heard(echogram, bench.ping->due).send.at(0).bytes;
    EXPECT_EQ(be(b, 64), 0x8000U | (900 - 50));
    EXPECT_NEAR(be(b, 66) & 0x7FFF, 900 + 30, 1);
    EXPECT_EQ(be(b, 68), 0x8000U | 3400);
}

TEST(DeltaT, OptionsChangeTheWords) {
    Bench mixed = delta_t({{"month", std::string("mixed")}, {"intensity", false}, {"orientation", false}});
    const Bytes b = next_83p(mixed);
    EXPECT_EQ(text_at(b, 8, 11), "01-Jan-1970");
    EXPECT_EQ(b.size(), 256U + 2 * 240);
    EXPECT_EQ(b[117], 0);
    EXPECT_EQ(be(b, 64), 0U);
    Bench coarse = delta_t({{"range_steps", std::string("500")}, {"beams", std::string("480")}});
    const Bytes c = heard_over(coarse, flat(8));
    EXPECT_EQ(c.size(), 2176U) << "the largest datagram";
    EXPECT_EQ(be(c, 85), 40U);
    EXPECT_EQ(be(c, 72), 500U);
    EXPECT_EQ(c[122], 0);
    EXPECT_NEAR(range_of(c, 240), 8, 0.04);
}

TEST(DeltaT, FloatsAreZeroOrOfTheOrderThatIsAskedFor) {
    const auto altitude = [](const char* floats) {
        Bench bench = delta_t({{"floats", std::string(floats)}});
        const Bytes b = heard_over(bench, flat(8));
        return Bytes(b.begin() + 133, b.begin() + 137);
    };
    EXPECT_EQ(altitude("zeros"), Bytes(4, 0));
    const Bytes big = altitude("big"), little = altitude("little");
    EXPECT_NEAR(std::bit_cast<float>(static_cast<std::uint32_t>(be(big, 0, 4))), 8, 0.02);
    EXPECT_EQ(Bytes(little.rbegin(), little.rend()), big);
}

}  // namespace
}  // namespace echoloop::test
