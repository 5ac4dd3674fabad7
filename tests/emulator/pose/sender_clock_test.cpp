// The sender's clock and ours: what a varying delay, a restart and a leap do to the time of a pose.
#include <gtest/gtest.h>

#include "emulator/pose/input.h"

namespace echoloop::test {
namespace {

TEST(SenderClock, TheLeastDelayTellsTheDifference) {
    SenderClock clock;
    clock.run_time(100.0, from_seconds(1.050));  // 50 ms late
    EXPECT_NEAR(to_seconds(clock.run_time(100.1, from_seconds(1.105))), 1.105,
                1e-6);  // 5 ms late: the best so far
    EXPECT_NEAR(to_seconds(clock.run_time(100.2, from_seconds(1.290))), 1.205, 1e-6);
}

TEST(SenderClock, ASimulatorThatRunsSlowerThanRealTimeIsNotLeftBehind) {
    SenderClock clock;
    for (int i = 0; i < 600; ++i) {  // a minute at nine tenths of real time, twenty poses a second of its own
        const double sent = i * 0.05, arrival = sent / 0.9;
        EXPECT_NEAR(to_seconds(clock.run_time(sent, from_seconds(arrival))), arrival, 0.11) << sent;
    }
}

TEST(SenderClock, AnotherClockIsTakenAsItIs) {
    SenderClock clock;
    clock.run_time(100.0, from_seconds(1));
    EXPECT_NEAR(to_seconds(clock.run_time(0.0, from_seconds(2))), 2, 1e-6);    // restarted
    EXPECT_NEAR(to_seconds(clock.run_time(500.0, from_seconds(3))), 3, 1e-6);  // leapt ahead
}

}  // namespace
}  // namespace echoloop::test
