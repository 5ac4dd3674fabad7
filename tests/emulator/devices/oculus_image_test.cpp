// What an Oculus shows: ranges, bearings, samples and gains, and the options that bear on them.
#include <bit>
#include <cmath>

#include "tests/emulator/devices/oculus_bench.h"

namespace echoloop::test {
namespace {

TEST(OculusRange, IsRowsTimesResolutionAndBoundedByTheMode) {
    OculusBench bench;
    // As in the real capture: 703 rows of c / (2 * 262237.76 Hz) for 2 m at 1490.6586 m/s.
    const Seen real = bench.next_after(fire({.mode = 2, .range = 2, .sound_speed = 1490.6586}));
    EXPECT_EQ(real.ranges(), 703U);
    EXPECT_NEAR(real.resolution(), 2.8421889710794e-3, 1e-9);
    EXPECT_NEAR(at<double>(real.bytes, 61), 2098880.597, 1e-3);
    const auto reach = [&](const Wish& wish) {
        bench.say(fire(wish));
        bench.next();
        const Seen seen = bench.next();
        EXPECT_LE(seen.ranges(), 1024U);
        return static_cast<double>(seen.ranges()) * seen.resolution();
    };
    EXPECT_NEAR(reach({.mode = 2, .range = 10}), 10, 0.01);
    EXPECT_NEAR(reach({.mode = 2, .range = 99}), 10, 0.01) << "the mode's longest";
    EXPECT_NEAR(reach({.mode = 1, .range = 99}), 40, 0.05);
    EXPECT_NEAR(reach({.mode = 1, .flags = 0x08, .range = 25}), 10, 0.05) << "percent of 40 m";
    EXPECT_NEAR(reach({.mode = 1, .range = -5}), 0.1, 0.01);
}

TEST(OculusBearings, AreEqualInSineOverTheModesSector) {
    OculusBench bench;
    const Seen high = bench.next_after(fire({.mode = 2}));
    for (std::size_t i = 0; i < 256; ++i) {
        const double degrees = std::asin(-0.5 + static_cast<double>(i) / 255) * 180 / M_PI;
        EXPECT_EQ(high.bearing(i), std::trunc(100 * degrees + std::copysign(1e-9, degrees))) << i;
    }
    bench.say(fire({.mode = 1, .flags = 0x49}));
    bench.next();
    const Seen low = bench.next();
    ASSERT_EQ(low.beams(), 512U);
    EXPECT_EQ(low.bearing(0), -6500);
    EXPECT_EQ(low.bearing(511), 6500);
    const auto sine = [&](std::size_t i) { return std::sin(low.bearing(i) * M_PI / 18000); };
    for (std::size_t i = 1; i < 512; ++i)
        EXPECT_NEAR(sine(i) - sine(i - 1), 2 * std::sin(65 * M_PI / 180) / 511, 3e-4);
    OculusBench m370s({}, "oculus-m370s");
    EXPECT_EQ(m370s.next_after(fire({.flags = 0x49})).beams(), 256U) << "the most that it has";
}

TEST(OculusImage, HasAnEchoInItsRowAndNowhereElse) {
    for (const int flags : {0x09, 0x0B, 0x0D, 0x4F, 0x1D}) {
        OculusBench bench;
        bench.echo_bin = 100, bench.echo_power = 1e13F;
        const Seen seen = bench.next_after(fire({.flags = flags}));
        for (std::size_t row = 0; row < seen.ranges(); ++row)
            for (std::size_t beam = 0; beam < seen.beams(); beam += 51)
                ASSERT_EQ(seen.sample(row, beam) > 0, row == 100) << flags << ' ' << row << ' ' << beam;
    }
}

TEST(OculusImage, ReadsTheSameInEveryDataSize) {
    const auto share = [](const Bytes& request, double full) {
        OculusBench bench;
        bench.echo_bin = 50, bench.echo_power = 1e13F;
        return bench.next_after(request).sample(50, 7) / full;
    };
    const double bits8 = share(fire({}, true), 254), bits16 = share(fire({.flags = 0x0B}, true), 65535);
    const double bits32 = share(fire({.flags = 0x0B, .ext_flags = 0x200}, true), 4294967295.0);
    EXPECT_GT(bits16, 0.1);
    EXPECT_NEAR(bits8, bits16, 1 / 254.0);
    EXPECT_NEAR(bits32, bits16, 1 / 65535.0);
}

TEST(OculusImage, Has32BitSamplesOf512BeamsBehindGainWords) {
    const auto seen = [](std::uint32_t ext_flags) {
        OculusBench bench;
        bench.echo_bin = 100, bench.echo_power = 1e13F;
        return bench.next_after(fire({.flags = 0x4F, .ext_flags = ext_flags}, true));
    };
    const Seen wide = seen(0x200), narrow = seen(0);
    EXPECT_EQ(wide.bytes.at(161), 3) << "data size: 32 bit";
    EXPECT_EQ(narrow.bytes.at(161), 1);
    ASSERT_EQ(at<std::uint16_t>(wide.bytes, 172), 512);
    const std::size_t rows = at<std::uint16_t>(wide.bytes, 170), row_bytes = 4 + 512 * 4;
    const std::size_t image = at<std::uint32_t>(wide.bytes, 190);
    EXPECT_GE(image, 202 + 2 * 512U) << "behind the bearings";
    EXPECT_EQ(at<std::uint32_t>(wide.bytes, 194), rows * row_bytes);
    EXPECT_EQ(at<std::uint32_t>(wide.bytes, 198), wide.bytes.size());
    EXPECT_EQ(image + rows * row_bytes, wide.bytes.size());
    EXPECT_EQ(at<std::uint32_t>(wide.bytes, image + 100 * row_bytes), narrow.gain_word(100));
    for (const std::size_t beam : {std::size_t{0}, std::size_t{511}}) {
        const double sample = at<std::uint32_t>(wide.bytes, image + 100 * row_bytes + 4 + 4 * beam);
        EXPECT_NEAR(sample / 4294967295.0, narrow.sample(100, beam) / 65535, 1 / 65535.0);
        EXPECT_GT(sample, 4294967295.0 / 100);
    }
}

TEST(OculusImage, GainRaisesTheEchoAndGainWordsTakeItOutAgain) {
    const auto seen = [](double gain, int flags, int mode = 1) {
        OculusBench bench;
        bench.echo_bin = 50, bench.echo_power = 1e11F;
        return bench.next_after(fire({.mode = mode, .flags = flags, .gain = gain}));
    };
    const Seen low = seen(20, 0x0F), high = seen(80, 0x0F);
    const double span = 30;  // dB from 0 to 100 %
    EXPECT_NEAR(20 * std::log10(high.sample(50, 9) / low.sample(50, 9)), 0.6 * span, 0.1);
    const auto amplitude = [](const Seen& s) { return s.sample(50, 9) / std::sqrt(s.gain_word(50)); };
    EXPECT_NEAR(amplitude(high) / amplitude(low), 1, 0.01);
    EXPECT_GT(low.gain_word(900), low.gain_word(50)) << "time-varied gain";
    // 0 to 100 % is 40 to 100 % in high frequency, and echoed so.
    EXPECT_EQ(at<double>(seen(50, 0x0F, 2).bytes, 29), 70);
    EXPECT_EQ(at<double>(seen(50, 0x0F, 1).bytes, 29), 50);
}

TEST(OculusImage, GammaLiftsTheDark) {
    const auto share = [](int gamma) {
        OculusBench bench;
        bench.echo_bin = 50, bench.echo_power = 1e11F;
        return bench.next_after(fire({.gamma = gamma, .flags = 0x0B})).sample(50, 9) / 65535;
    };
    const double linear = share(255);
    EXPECT_GT(linear, 0.01);
    EXPECT_LT(linear, 0.3);
    EXPECT_EQ(share(0), linear);
    EXPECT_NEAR(share(127), std::sqrt(linear), 1e-4);
    EXPECT_NEAR(share(191), std::pow(linear, 0.75), 1e-3);
    EXPECT_NEAR(share(63), std::pow(linear, 0.25), 1e-3);
}

TEST(OculusImage, GainAssistKeepsARowWithinFullScale) {
    const auto sample = [](int flags) {
        OculusBench bench;
        bench.echo_bin = 50, bench.echo_power = 1e17F;
        const Seen seen = bench.next_after(fire({.flags = flags}));
        return std::pair(seen.sample(50, 9), seen.gain_word(50));
    };
    const auto [clipped, gain] = sample(0x0D);
    const auto [whole, assisted] = sample(0x1D);
    EXPECT_EQ(clipped, 254);
    EXPECT_LE(whole, 254);
    EXPECT_GT(whole, 200);
    EXPECT_LT(assisted, gain);
}

TEST(OculusSoundSpeed, IsTheHostsOrFollowsFromTemperatureAndSalinity) {
    OculusBench bench({{"temperature", 15.0}});
    const auto used = [&](const Wish& wish) {
        bench.say(fire(wish));
        bench.next();
        return bench.next();
    };
    EXPECT_EQ(used({.sound_speed = 1523.5}).sound_speed(), 1523.5);
    // Medwin 1975 at 15 degC: published values are 1506.6 (sea) and 1465.9 (fresh).
    const Seen sea = used({.sound_speed = 0, .salinity = 35});
    EXPECT_NEAR(sea.sound_speed(), 1506.6, 0.5);
    EXPECT_EQ(at<double>(sea.bytes, 37), 0) << "echoed as requested";
    EXPECT_NEAR(used({.sound_speed = 0, .salinity = 0}).sound_speed(), 1465.9, 1.5);
    EXPECT_NEAR(sea.resolution() / sea.sound_speed(),
                1 / (2 * 150e3) * std::ceil(10 / (sea.sound_speed() / 300e3) / 1024), 1e-9);
}

TEST(OculusOptions, ChangeWhatTheSpecificationLeavesOpen) {
    const auto seen = [](const Options& options, const Wish& wish, bool v2 = false) {
        OculusBench bench(options);
        bench.echo_bin = 20, bench.echo_power = 1e12F;
        return bench.next_after(fire(wish, v2));
    };
    using S = std::string;
    EXPECT_EQ(seen({{"data_16_bit", S("clear")}}, {.flags = 0x09}).sample_bytes(), 2U);
    EXPECT_EQ(seen({{"data_16_bit", S("clear")}}, {.flags = 0x0B}).sample_bytes(), 1U);
    EXPECT_EQ(at<double>(seen({{"gain_echo", S("plain")}}, {.mode = 2}).bytes, 29), 50);
    EXPECT_NEAR(at<double>(seen({{"sound_speed_echo", S("used")}}, {.sound_speed = 0}).bytes, 37), 1490, 5);
    EXPECT_EQ(seen({{"rate_echo", S("requested")}}, {.rate = 2}).bytes[17], 2);
    EXPECT_EQ(seen({}, {.rate = 2}).bytes[17], 195) << "as a real unit's recording has it";
    EXPECT_EQ(at<double>(seen({{"sensors", S("garbage")}}, {}).bytes, 77), -1e194);
    EXPECT_TRUE(seen({{"result_version", S("v2")}}, {}).v2) << "to a fire of version 1";
    EXPECT_FALSE(seen({{"result_version", S("v1")}}, {}, true).v2);
    EXPECT_EQ(at<std::uint16_t>(seen({{"message_device_id", std::int64_t{7}}}, {}).bytes, 2), 7);
    const Wish percent{.flags = 0x0B, .range = 50, .ext_flags = 0x200};
    const Seen half = seen({{"range_in_32_bit", S("percent")}}, percent, true);
    EXPECT_NEAR(static_cast<double>(half.ranges()) * half.resolution(), 20, 0.1) << "half of 40 m";
    const Seen words = seen({{"gain_word", S("f32")}}, {.flags = 0x0D});
    EXPECT_EQ(std::bit_cast<float>(words.gain_word(20)),
              static_cast<float>(seen({}, {.flags = 0x0D}).gain_word(20)));
}

TEST(OculusOptions, NegativeBearingsMayBeStarboard) {
    for (const bool starboard : {false, true}) {
        OculusBench bench({{"negative_bearing", std::string(starboard ? "starboard" : "port")}});
        bench.say(fire({}));
        bench.run_to(bench.now);
        Echogram echogram = echo_of(bench.ping->shot, 0, 0);
        echogram.values[10 * echogram.shot.bins + 20] = 1e14F;  // beam 10 is to port
        const Seen seen(bench.device().heard(echogram, bench.ping->due).send.at(0).bytes);
        EXPECT_GT(seen.sample(20, starboard ? 245 : 10), 0);
        EXPECT_EQ(seen.sample(20, starboard ? 10 : 245), 0);
    }
}

}  // namespace
}  // namespace echoloop::test
