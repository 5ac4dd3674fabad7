// That threads of devices do all that they are asked, beside each other.
#include "emulator/run/device_threads.h"

#include <gtest/gtest.h>

#include <atomic>

namespace echoloop {
namespace {

TEST(DeviceThreadsOfARun, DoAllThatTheyWereAskedBeforeTheyEnd) {
    std::atomic<int> done = 0;
    {
        DeviceThreads threads;
        for (int i = 0; i < 1000; ++i) threads.post([&done] { ++done; });
    }
    EXPECT_EQ(done, 1000);
}

TEST(DeviceThreadsOfARun, WorkBesideEachOther) {
    DeviceThreads threads;
    std::atomic<bool> other_came = false;
    threads.post([&other_came] { other_came.wait(false); });
    threads.post([&other_came] {
        other_came = true;
        other_came.notify_all();
    });
    threads.join();
    EXPECT_TRUE(other_came);
}

}  // namespace
}  // namespace echoloop
