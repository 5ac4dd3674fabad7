// What the kernel grants a thread that must wake on time.
#include "emulator/machine/scheduling.h"

#include <gtest/gtest.h>
#include <sys/prctl.h>

#include <thread>

namespace echoloop::test {
namespace {

TEST(Punctual, TimersOfThisThreadHaveNoSlackAndThoseOfOthersKeepTheirs) {
    const auto slack = [] { return ::prctl(PR_GET_TIMERSLACK, 0UL, 0UL, 0UL, 0UL); };
    const int usual = slack();
    int granted = 0;
    std::thread([&] {
        wake_on_time();
        granted = slack();
    }).join();
    EXPECT_EQ(granted, 1);
    EXPECT_EQ(slack(), usual);
}

}  // namespace
}  // namespace echoloop::test
