// The Kongsberg multibeam on the bench: what stands at the offsets of its datagrams, when they come, and what
// the controller's texts change. Offsets are those of the specification notes on KMALL.
#include "tests/emulator/devices/kmall_bench.h"

namespace echoloop::test {
namespace {
/// The only #MRZ of a bottom.
Bytes mrz(const Bottom& bottom, const Pose& pose, const Options& changes = {}) {
    Bench bench = sounder(changes);
    bench.run_to(0ns);
    Echogram echo = bottom_echo(bench.ping->shot, bottom, {});
    echo.world_from_sonar = pose;
    const auto sent = bench.device().heard(echo, bench.ping->due).send;
    EXPECT_EQ(type(sent.at(0)), "#MRZ");
    return sent.at(0).bytes;
}

Pose looking_down(double roll, double yaw, Vec3 position) {
    return {position, from_rpy(roll, 0, yaw) * from_rpy(0, deg_to_rad(90), 0)};
}

TEST(Kmall, ItsFirstDatagramIsWhatTheNotesSay) {
    const Bytes b = mrz(flat(8), looking_down(0, deg_to_rad(90), {0, 0, -12}));
    EXPECT_EQ(b.size(), first + 400 * 120 + 2 * image_samples(b) + 4);
    EXPECT_EQ(at<std::uint32_t>(b, 0), b.size());
    EXPECT_EQ(at<std::uint32_t>(b, b.size() - 4), b.size());
    EXPECT_EQ(b[8], 3) << "81 of 81 real ones";
    EXPECT_EQ(u16(b, 10), 2040);
    EXPECT_EQ(b[9], 40) << "system";
    EXPECT_EQ(u16(b, 20), 1) << "one part";
    EXPECT_EQ(u16(b, 22), 1);
    EXPECT_EQ(u16(b, 24), 12);
    EXPECT_EQ(u16(b, 26), 1) << "ping";
    EXPECT_EQ(u16(b, ping), 152);
    EXPECT_EQ(f32(b, ping + 16), 300e3F);
    EXPECT_EQ(u16(b, ping + 92), 1);
    EXPECT_EQ(u16(b, ping + 94), 48);
    EXPECT_EQ(f32(b, ping + 100), 1500);
    EXPECT_EQ(u16(b, rx), 32);
    EXPECT_EQ(u16(b, rx + 2), 400);
    EXPECT_EQ(u16(b, rx + 6), 120);
    EXPECT_NEAR(f32(b, first + 72), 60, 1e-3) << "port first, positive to port";
    EXPECT_LT(f32(b, first + 100), -10) << "y of the port-most";
}

TEST(Kmall, VersionZeroIsShorter) {
    const Bytes b = mrz(flat(8), looking_down(0, 0, {0, 0, -12}), {{"mrz_version", std::string("0")}});
    EXPECT_EQ(b[8], 0);
    EXPECT_EQ(u16(b, ping), 144);
    EXPECT_EQ(u16(b, ping + 94), 36);
    EXPECT_EQ(u16(b, ping + 144 + 36), 32);
    EXPECT_EQ(b.size(), first - 8 - 12 + 400 * 120 + 2 * image_samples(b, first - 20) + 4);
}

TEST(Kmall, AFlatFloorIsFlatWhateverTheRoll) {
    for (const double roll : {0.0, 12.0, -7.0}) {
        const double r = deg_to_rad(roll);
        // The beam at `angle` of a head rolled by r (starboard down) looks at angle - r from the vertical.
        const Bottom floor = [r](double angle) { return 8 / std::cos(angle - r); };
        const Bytes b = mrz(floor, looking_down(r, 1.0, {3, 4, -12}), {{"sector_width", 100.0}});
        EXPECT_GT(u16(b, rx + 4), 390) << "valid";
        for (std::size_t n = 0; n < 400; ++n) {
            const std::size_t s = first + n * 120;
            if (b[s + 3] != 0) continue;
            EXPECT_NEAR(f32(b, s + 96), 8, 0.04) << "z of " << n << " at roll " << roll;
            EXPECT_NEAR(f32(b, s + 104), 0, 1e-3) << "x";
            const double angle = deg_to_rad(f32(b, s + 72)), range = f32(b, s + 80) * 750;
            EXPECT_NEAR(f32(b, s + 100), range * std::sin(-angle - r), 1e-3) << "y";
        }
    }
}

TEST(Kmall, PositionAndHeadingAreThoseOfTheHead) {
    const double yaw = deg_to_rad(30);  // from east towards north: heading 60
    const Bytes b =
        mrz(flat(8), looking_down(0, yaw, {1852, 3704, -12}), {{"latitude", 60.0}, {"longitude", 5.0}});
    EXPECT_NEAR(f32(b, ping + 96), 60, 1e-3);
    EXPECT_NEAR(f32(b, ping + 104), 12, 1e-5);
    EXPECT_NEAR(f32(b, ping + 108), -12, 1e-5);
    // PROJ 9.1, +proj=ortho +ellps=WGS84 about the origin.
    EXPECT_NEAR(at<double>(b, ping + 124), 60.0332416280, 1e-9);
    EXPECT_NEAR(at<double>(b, ping + 132), 5.0332233005, 1e-9);
    // The port-most point: y metres to the left of the heading.
    const double y = f32(b, first + 100), heading = deg_to_rad(60);
    EXPECT_NEAR(f32(b, first + 88), -y * std::sin(heading) * 8.9757e-6, 1e-7);
    EXPECT_NEAR(f32(b, first + 92), y * std::cos(heading) * 1.79212e-5, 1e-7);
}

TEST(Kmall, WhereThereIsNoEchoSoundingsAreRejected) {
    Bench bench = sounder();
    bench.run_to(100ms);
    const Bytes b = bench.sent().at(0).bytes;
    EXPECT_EQ(u16(b, rx + 2), 400);
    EXPECT_EQ(u16(b, rx + 4), 0);
    EXPECT_EQ(b[first + 3], 2);
    EXPECT_EQ(b[first + 4], 0);
    EXPECT_EQ(f32(b, first + 80), 0);
}

/// As in the files of an EM 2042: no reader that shows all soundings sees some at the head.
TEST(Kmall, RejectedSoundingsLieWhereTheBottomOfTheOthersGoesOn) {
    const Bottom holed = [](double angle) {
        const bool hole = (angle > -0.6 && angle < -0.4) || angle > 0.8;
        return hole ? 1000.0 : sloping(8, 0.1)(angle);
    };
    const Bytes b = mrz(holed, looking_down(0, 0, {0, 0, -12}));
    int in_hole = 0, beyond = 0;
    double outermost = 0;
    for (std::size_t n = 0; n < 400; ++n) {
        const std::size_t s = first + n * 120;
        const double angle = -deg_to_rad(f32(b, s + 72)), z = f32(b, s + 96), range = f32(b, s + 80) * 750;
        if (b[s + 3] == 0) {
            EXPECT_EQ(b[s + 5], 0);
            outermost = z;
            continue;
        }
        EXPECT_EQ(b[s + 3], 2);
        EXPECT_EQ(b[s + 4], 0) << "no method";
        EXPECT_EQ(b[s + 5], 0) << "rejection info 1, in all real ones";
        EXPECT_EQ(b[s + 6], 40) << "rejection info 2";
        EXPECT_EQ(f32(b, s + 12), 100);
        EXPECT_NEAR(f32(b, s + 100), range * std::sin(angle), 1e-3) << "y";
        EXPECT_NEAR(z, range * std::cos(angle), 1e-3);
        if (angle < 0) {
            EXPECT_NEAR(z, sloping(8, 0.1)(angle) * std::cos(angle), 0.15) << "between";
            ++in_hole;
        } else {
            EXPECT_NEAR(z, outermost, 1e-3) << "level beyond the last";
            ++beyond;
        }
    }
    EXPECT_GT(in_hole, 10);
    EXPECT_GT(beyond, 10);
}

TEST(Kmall, CoverageIsInDegreesPositiveToPortAndInMetresToStarboard) {
    const Bytes b = mrz(flat(8), looking_down(0, 0, {0, 0, -12}), {{"sector_width", 100.0}});
    EXPECT_NEAR(f32(b, ping + 52), 50, 0.5);
    EXPECT_NEAR(f32(b, ping + 56), -50, 0.5);
    EXPECT_EQ(at<std::int16_t>(b, ping + 60), -10) << "8 m tan 50 deg";
    EXPECT_EQ(at<std::int16_t>(b, ping + 62), 10);
}

TEST(Kmall, PingsComeAtTheRateThatTheRangeAllows) {
    Bench bench = sounder();
    bench.run_to(0ns);
    EXPECT_NEAR(to_seconds(bench.ping->due), 80 / 1500.0 + 0.005, 1e-6);
    bench.run_to(1990ms);
    EXPECT_EQ(bench.device().counters().pings, 10U);
    Bench far = sounder({{"range", 300.0}, {"ping_rate", 50.0}});  // 0.4 s and 10 ms
    far.run_to(4s);
    EXPECT_EQ(far.device().counters().pings, 9U);
    EXPECT_NEAR(f32(far.sent().at(1).bytes, ping + 4), 1 / 0.41, 1e-3);
}

TEST(Kmall, OptionsShapeTheFan) {
    Bench bench = sounder({{"beam_spacing", std::string("equiangle")},
                           {"soundings", std::int64_t{64}},
                           {"sector_width", 90.0},
                           {"frequency", 200e3},
                           {"power", -10.0},
                           {"pulse", 100e-6}});
    bench.run_to(0ns);
    const Shot& shot = bench.ping->shot;
    ASSERT_EQ(shot.bearings.size(), 64U);
    EXPECT_NEAR(shot.bearings.front(), -deg_to_rad(45), 1e-9);
    EXPECT_NEAR(shot.bearings[1] - shot.bearings[0], deg_to_rad(90) / 63, 1e-9);
    EXPECT_NEAR(shot.beam_width, deg_to_rad(0.8), 1e-9) << "0.4 deg at 400 kHz";
    EXPECT_NEAR(shot.source_level, 200, 1e-9);
    EXPECT_NEAR(shot.pulse_length, 100e-6, 1e-12);
    Bench even = sounder({{"beam_spacing", std::string("equidistant")}});
    even.run_to(0ns);
    const auto& a = even.ping->shot.bearings;
    EXPECT_NEAR(std::tan(a[1]) - std::tan(a[0]), std::tan(a[200]) - std::tan(a[199]), 1e-9);
}

TEST(Kmall, TextsStopAndStartIt) {
    Bench bench = sounder({{"pinging", false}});
    bench.run_to(2s);
    EXPECT_TRUE(bench.sent().empty());
    bench.say(text("$KSSIS,458,712"));
    bench.run_to(3s);
    EXPECT_TRUE(bench.sent().empty()) << "that is another sounder";
    bench.say(text("$KSSIS,458,2040"));
    bench.run_to(3900ms);
    EXPECT_EQ(bench.sent().size(), 5U);
    bench.say(text("$KSSIS,457,2040\r\n"));
    bench.run_to(4100ms);
    bench.sent();
    bench.run_to(8s);
    EXPECT_TRUE(bench.sent().empty());
    bench.say(text("$KSSIS,458,EM2040_41"));
    bench.run_to(9s);
    EXPECT_TRUE(bench.sent().empty()) << "that is another of the same kind";
    for (const char* name : {"EM2040_40", "EM2040"}) {
        bench.say(text("$KSSIS,458," + std::string(name) + "\r\n"));
        bench.run_to(bench.now + 1s);
        EXPECT_FALSE(bench.sent().empty()) << name;
        bench.say(text("$KSSIS,457," + std::string(name)));
        bench.run_to(bench.now + 1s);
        bench.sent();
    }
    bench.say(text("$KSSIS,458"));
    EXPECT_EQ(bench.device().counters().rejected, 1U);
}

TEST(Kmall, TheWaterColumnComesInPartsWhereAskedFor) {
    Bench bench = sounder({{"range", 20.0}, {"pulse", 70e-6}});
    bench.run_to(100ms);
    EXPECT_TRUE(of_type(bench.sent(), "#MWC").empty());
    bench.say(text("$KSSIS,461,2040"));
    bench.run_to(300ms);
    const auto parts = of_type(bench.sent(), "#MWC");
    // 20 m: 1524 bins of 17.5 us, 381 samples of each of 400 beams.
    const std::size_t body = 12 + 12 + 16 + 16 + 400 * (16 + 381);
    ASSERT_EQ(parts.size(), 3U);
    std::size_t sum = 0;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const Bytes& b = parts[i].bytes;
        EXPECT_LE(b.size(), 65000U);
        EXPECT_EQ(at<std::uint32_t>(b, 0), b.size());
        EXPECT_EQ(at<std::uint32_t>(b, b.size() - 4), b.size());
        EXPECT_EQ(u16(b, 20), 3);
        EXPECT_EQ(u16(b, 22), i + 1);
        EXPECT_EQ(parts[i].not_before - parts[0].not_before, static_cast<int>(i) * 2ms)
            << "receivers lose bursts";
        sum += b.size() - 28;
    }
    EXPECT_EQ(sum, body);
    bench.say(text("$KSSIS,460,2040"));
    bench.run_to(1s);
    EXPECT_TRUE(of_type(bench.sent(), "#MWC").empty());
}

TEST(Kmall, TheWaterColumnHasTheEchoAtItsSample) {
    Bench bench =
        sounder({{"range", 20.0}, {"pulse", 70e-6}, {"water_column", true}, {"soundings", std::int64_t{16}}});
    bench.echo_bin = 610;  // of 17.5 us: sample 152
    bench.echo_power = 1e15F;
    bench.run_to(100ms);
    const auto sent = of_type(bench.sent(), "#MWC");
    ASSERT_EQ(sent.size(), 1U);
    const Bytes& b = sent[0].bytes;
    constexpr std::size_t rx_info = 36 + 12 + 16, beam = rx_info + 16;
    EXPECT_EQ(u16(b, rx_info + 2), 16);
    EXPECT_EQ(b[rx_info + 4], 16);
    EXPECT_NEAR(f32(b, rx_info + 8), 1 / 70e-6, 1);
    EXPECT_EQ(u16(b, beam + 10), 381);
    EXPECT_NEAR(f32(b, beam + 12), 152.5 - 0.5, 0.6);
    EXPECT_NEAR(u16(b, beam + 6), f32(b, beam + 12), 1);
    const auto amplitude = [&](std::size_t sample) {
        return static_cast<int>(static_cast<std::int8_t>(b[beam + 16 + sample]));
    };
    EXPECT_EQ(amplitude(151), -128);
    // 150 dB less a quarter in the mean, 30 log 8 m and 2 x 70 dB/km, and the offset of 30 dB, less 170 dB;
    // in halves of a dB
    EXPECT_NEAR(amplitude(152), 2 * (150 - 6.02 + 30 * std::log10(8.0) + 0.14 * 8.0 + 30 - 170), 1);
}

// The program's own logarithm rounds as the C library's does, over all that an int8 holds.
TEST(Kmall, TheWaterColumnIsRoundedToHalfADecibel) {
    const auto reading = [](double level) {
        Bench bench = sounder(
            {{"range", 20.0}, {"pulse", 70e-6}, {"water_column", true}, {"soundings", std::int64_t{2}}});
        bench.echo_bin = 610;
        bench.echo_power = static_cast<float>(std::pow(10, level / 10));
        bench.run_to(100ms);
        const auto sent = of_type(bench.sent(), "#MWC");
        return static_cast<int>(static_cast<std::int8_t>(sent.at(0).bytes.at(36 + 12 + 16 + 16 + 16 + 152)));
    };
    const double range = 152.5 * 70e-6 * 750, gain = 30 * std::log10(range) + 2 * 0.07 * range + 30 - 170;
    for (double level = 60; level < 180; level += 0.613) {
        const double exact = 2 * (level - 10 * std::log10(4.0) + gain);
        EXPECT_NEAR(reading(level), std::clamp(exact, -128.0, 127.0), 0.501) << level;
    }
}

TEST(Kmall, EndpointsThatCannotBeAreRefused) {
    EXPECT_THROW(make_device("kongsberg-kmall", {"udp-listen://127.0.0.1:4002"}), std::invalid_argument);
    EXPECT_THROW(
        make_device("kongsberg-kmall", {"udp-listen://127.0.0.1:4002", "tcp-listen://127.0.0.1:6020"}),
        std::invalid_argument);
    EXPECT_NO_THROW(make_device("kongsberg-kmall", {"udp-listen://0.0.0.0:4002", "udp://225.1.20.40:6020"}));
}

TEST(Kmall, FlippedBytesDoNotWedgeIt) {
    Bench bench = sounder({{"range", 4.0}, {"soundings", std::int64_t{16}}, {"ping_rate", 50.0}});
    const auto hex = [](const std::string& t) { return to_hex(text(t)); };
    const NoisyHost line{.words = {hex("$KSSIS,262,2040,SSPA1=50,STPF=50"), hex("$KSSIS,457,2040"),
                                   hex("$KSSIS,458,2040"), hex("$KSSIS,461,2040"), hex("$KSSIS,460,2040")},
                         .request = hex("$KSSIS,458,2040"),
                         .is_answer = [](const Send& send) { return type(send) == "#MRZ"; },
                         .patience = 50ms};
    expect_no_wedge(bench, line, 300);
}

}  // namespace
}  // namespace echoloop::test
