// Percentiles of lateness against those of the sorted list.
#include "emulator/run/lateness.h"

#include <gtest/gtest.h>

#include <random>

namespace echoloop {
namespace {

using namespace std::chrono_literals;

TEST(Lateness, PercentilesAreThoseOfTheListWithinFivePercent) {
    std::mt19937 random(1);
    std::lognormal_distribution<double> microseconds(5, 1.5);
    Lateness lateness;
    std::vector<double> all;
    for (int i = 0; i < 10000; ++i) {
        all.push_back(std::max(1.0, microseconds(random)));
        lateness.add(from_seconds(all.back() * 1e-6));
    }
    std::ranges::sort(all);
    for (const double part : {0.5, 0.9, 0.99, 0.999}) {
        const double exact = all[static_cast<std::size_t>(part * 10000) - 1] * 1e-6;
        const double read = to_seconds(lateness.not_exceeded_by(part));
        EXPECT_GE(read, exact * 0.9999) << part;
        EXPECT_LE(read, exact * 1.05) << part;
    }
    EXPECT_EQ(lateness.not_exceeded_by(1), lateness.worst());
}

TEST(Lateness, WithoutAnyAndWithNoneLate) {
    Lateness lateness;
    EXPECT_EQ(lateness.not_exceeded_by(0.99), 0ns);
    lateness.add(0ns);
    lateness.add(1h);
    EXPECT_EQ(lateness.not_exceeded_by(0.5), 1us);
    EXPECT_EQ(lateness.worst(), 1h);
    EXPECT_EQ(lateness.count(), 2);
}

}  // namespace
}  // namespace echoloop
