// When pings are spared something, and when it comes back.
#include "emulator/run/overload.h"

#include <gtest/gtest.h>

namespace echoloop {
namespace {

using namespace std::chrono_literals;

void hear(Overload& overload, int pings, Time waited) {
    for (int i = 0; i < pings; ++i) overload.heard(waited);
}

TEST(Overload, SparesNothingForSinglePingsThatAreLate) {
    Overload overload;
    for (int i = 0; i < 1000; ++i) {
        hear(overload, 4, 200ms);
        hear(overload, 1, 20ms);
        hear(overload, 1, 10s);
        hear(overload, 1, 0s);
        ASSERT_TRUE(overload.late_echoes());
        ASSERT_EQ(overload.density(), 1);
    }
}

TEST(Overload, SparesLateEchoesFirstAndPixelsThen) {
    Overload overload;
    hear(overload, 5, 21ms);
    EXPECT_FALSE(overload.late_echoes());
    EXPECT_EQ(overload.density(), 1);
    hear(overload, 5, 21ms);
    EXPECT_FALSE(overload.late_echoes());
    EXPECT_EQ(overload.density(), 0.25);
}

// Sixteen sonars that wait for each other are not to wait for five pings of each.
TEST(Overload, SparesSoonWherePingsAreVeryLate) {
    Overload overload;
    hear(overload, 2, 201ms);
    EXPECT_FALSE(overload.late_echoes());
    EXPECT_EQ(overload.density(), 1);
    hear(overload, 2, 201ms);
    EXPECT_EQ(overload.density(), 0.25);
}

TEST(Overload, GivesBackOneAfterTheOther) {
    Overload overload;
    hear(overload, 10, 1s);
    hear(overload, 31, 0s);
    EXPECT_EQ(overload.density(), 0.25);
    hear(overload, 1, 0s);
    EXPECT_EQ(overload.density(), 1);
    EXPECT_FALSE(overload.late_echoes());
    hear(overload, 32, 0s);
    EXPECT_TRUE(overload.late_echoes());
}

// Pings that are in time only because they are drawn coarsely must not go to and fro all the time.
TEST(Overload, TriesLessAndLessOften) {
    Overload overload;
    hear(overload, 10, 1s);
    int coarse = 0, all = 0;
    for (int i = 0; i < 4000; ++i) {
        const bool is_coarse = overload.density() < 1;
        overload.heard(is_coarse ? 0s : 1s);
        coarse += is_coarse;
        all += 1;
    }
    EXPECT_GT(coarse, all * 98 / 100);
}

}  // namespace
}  // namespace echoloop
