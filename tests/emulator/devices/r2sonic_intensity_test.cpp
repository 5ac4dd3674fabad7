// The intensities of a Sonic 20xx: after gain and time-varied gain, as 923 real pings have them, with a scale
// of 1 whatever the echo.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/emulator/devices/r2sonic_bench.h"

namespace echoloop::test {
namespace {

/// The word of the middle point for an echo of `level` dB re 1 uPa whose middle is at 10 m; `scale` as it
/// stands in I1.
double word(double level, float& scale, const Options& more = {}) {
    Options options{
        {"intensity", true}, {"range", 20.0}, {"gain", 11.0}, {"spreading", 15.0}, {"absorption", 81.0}};
    for (const auto& [name, value] : more) options[name] = value;
    Bench bench = head(options);
    bench.run_to(1ms);
    Echogram echogram = echo_of(bench.ping->shot, 99999, 0);
    echogram.noise_power = 1;
    for (std::size_t beam = 0; beam < echogram.beams(); ++beam)
        for (std::size_t bin = 0; bin < echogram.shot.bins; ++bin)
            if (std::abs(echogram.bin_range(bin) - 10) < 0.5)
                echogram.values[beam * echogram.shot.bins + bin] =
                    static_cast<float>(std::pow(10, level / 10));
    bench.hear(echogram);
    const Bytes b = named(bench.sent(), "BTH0").at(0).bytes;
    constexpr std::size_t i1 = 12 + 116 + 520 + 36;  // behind H0, R0, A0
    EXPECT_EQ(name(b, i1, 2), "I1");
    scale = f32(b, i1 + 4);
    return u16(b, i1 + 8 + 2 * 128);
}

TEST(R2SonicIntensity, FollowsLevelGainAndSpreadingWithAScaleOfOne) {
    float scale = 0;
    for (const double level : {80.0, 100.0, 120.0, 140.0}) {
        // 22 dB of gain, 15 log 10 m, 2 x 81 dB/km x 10 m; 189.5 dB reads 65535.
        const double db = level + 22 + 15 + 1.62 - 189.5;
        EXPECT_NEAR(20 * std::log10(word(level, scale) / 65535), db, 0.5) << level;
        EXPECT_EQ(scale, 1.0F) << level;
    }
    EXPECT_NEAR(word(120, scale, {{"gain", 21.0}}) / word(120, scale), 10, 0.05) << "20 dB";
    EXPECT_EQ(word(200, scale), 65535);
    EXPECT_EQ(scale, 1.0F) << "too loud is cut off, not scaled";
}

}  // namespace
}  // namespace echoloop::test
