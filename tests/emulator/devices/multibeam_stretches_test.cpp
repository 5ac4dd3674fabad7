// Stretches as long as a beam's footprint: the greatest mean, with gain over time, is where looking at every
// bin finds it.
#include "emulator/devices/family/multibeam/stretches.h"

#include <gtest/gtest.h>

#include "tests/emulator/devices/seabed_echo.h"

namespace echoloop::test {
namespace {

using multibeam::Stretches;

/// By the sums of bins themselves, for every bin: the first with the greatest mean times the square of its
/// time, of those above `least`, and its mean. `first`: of the bins, in the window, which begins at 0 s.
std::pair<std::size_t, double> greatest(std::span<const float> bins, std::size_t first,
                                        const Stretches& stretches, double least) {
    std::pair<std::size_t, double> best{0, -1};
    double most = -1;
    for (std::size_t i = 0; i < bins.size(); ++i) {
        const std::size_t h = stretches.half(i);
        double sum = 0;
        for (std::size_t k = i - std::min(i, h); k < std::min(i + h + 1, bins.size()); ++k) sum += bins[k];
        const double mean = sum / static_cast<double>(2 * h + 1);
        const double time = static_cast<double>(first + i) + 0.5;
        if (mean > least && mean * time * time > most * (1 + 1e-12))
            best = {i, mean}, most = mean * time * time;
    }
    return best;
}

TEST(MultibeamStretches, HaveTheirGreatestMeanWhereEveryBinLookedAtHasIt) {
    Stretches stretches;
    const Shot shot = wide_fan(30);
    for (unsigned seed = 1; seed <= 8; ++seed) {
        const Echogram noise = empty_sea(shot, {.seed = seed});
        for (std::size_t beam = 0; beam < 256; beam += 17)
            for (const auto& [first, last] : {std::pair<std::size_t, std::size_t>{0, shot.bins},
                                              {40, 60},
                                              {seed, seed + 1},
                                              {shot.bins - 300, shot.bins}}) {
                stretches.start(noise, beam, first, last, std::vector<float>(shot.bins));
                for (const double least : {0.0, 1.0}) {
                    const auto [bin, mean] =
                        greatest(noise.beam(beam).subspan(first, last - first), first, stretches, least);
                    EXPECT_EQ(stretches.peak(least), bin) << beam << " seed " << seed << " from " << first;
                    if (mean > 0) {
                        EXPECT_NEAR(stretches.mean(bin), mean, 1e-9 * mean);
                    }
                }
            }
    }
}

TEST(MultibeamStretches, FindALoudBinAtEitherEndOfTheGate) {
    Stretches stretches;
    const Shot shot = wide_fan(30);
    for (const std::size_t loud : {std::size_t{100}, std::size_t{101}, std::size_t{898}, std::size_t{899}}) {
        Echogram e = empty_sea(shot, {});
        for (const std::size_t beam : {std::size_t{0}, std::size_t{128}}) {
            e.values[beam * shot.bins + loud] = 1e9F;
            stretches.start(e, beam, 100, 900, std::vector<float>(shot.bins));
            const std::size_t h = stretches.half(loud - 100);
            EXPECT_NEAR(static_cast<double>(stretches.peak(0)), static_cast<double>(loud - 100),
                        static_cast<double>(h));
        }
    }
}

TEST(MultibeamStretches, TakeTheFirstOfEqualOnesWhereNothingSpreads) {
    Stretches stretches;
    const Shot shot = wide_fan(30);
    Echogram even = empty_sea(shot, {});
    even.rule = EchoRule::cerqueira2016;
    std::ranges::fill(even.values, 1.0F);
    stretches.start(even, 128, 0, shot.bins, std::vector<float>(shot.bins));
    EXPECT_EQ(stretches.peak(0), stretches.half(0));  // before it footprints are cut off by the window
    even.values[128 * shot.bins + 700] = even.values[128 * shot.bins + 400] = 2;
    stretches.start(even, 128, 0, shot.bins, std::vector<float>(shot.bins));
    EXPECT_EQ(stretches.peak(0), 400 - stretches.half(400));
}

}  // namespace
}  // namespace echoloop::test
