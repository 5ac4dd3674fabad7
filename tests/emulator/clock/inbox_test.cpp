// That what other threads hand over happens on the thread of the clock, all of it and in order; and that listeners do
// all that they are asked.
#include "emulator/clock/inbox.h"

#include <gtest/gtest.h>

#include <atomic>
#include <map>
#include <thread>

#include "emulator/run/device_threads.h"

namespace echoloop {
namespace {

TEST(Inboxes, HandOverEverythingInOrderToTheThreadOfTheClock) {
    constexpr int threads = 4, events = 5000;
    asio::io_context io;
    Inbox inbox(io);
    const auto here = std::this_thread::get_id();
    std::map<int, int> seen;
    int left = threads * events, elsewhere = 0, out_of_order = 0;
    std::vector<std::jthread> posting;
    for (int thread = 0; thread < threads; ++thread)
        posting.emplace_back([&, thread] {
            for (int i = 0; i < events; ++i)
                inbox.post([&, thread, i] {
                    if (std::this_thread::get_id() != here) ++elsewhere;
                    if (seen[thread]++ != i) ++out_of_order;
                    if (--left == 0) io.stop();
                });
        });
    io.run();
    EXPECT_EQ(left, 0);
    EXPECT_EQ(elsewhere, 0);
    EXPECT_EQ(out_of_order, 0);
}

TEST(Inboxes, TakeWhatTheirOwnThreadPostsWhileItEmptiesThem) {
    asio::io_context io;
    Inbox inbox(io);
    std::vector<int> order;
    inbox.post([&] {
        order.push_back(1);
        inbox.post([&] {
            order.push_back(3);
            io.stop();
        });
    });
    inbox.post([&] { order.push_back(2); });
    io.run();
    EXPECT_EQ(order, (std::vector{1, 2, 3}));
}

TEST(Inboxes, ForgetWhatNobodyFetched) {
    asio::io_context io;
    const auto held = std::make_shared<int>();
    {
        Inbox inbox(io);
        inbox.post([held] {});
    }
    EXPECT_EQ(held.use_count(), 1);
    io.run();
}

TEST(ListenersOfARun, DoAllThatTheyWereAskedBeforeTheyEnd) {
    std::atomic<int> done = 0;
    {
        Listeners listeners(Punctuality::ordinary);
        for (int i = 0; i < 1000; ++i) listeners.post([&done] { ++done; });
    }
    EXPECT_EQ(done, 1000);
}

TEST(ListenersOfARun, WorkBesideEachOther) {
    Listeners listeners(Punctuality::ordinary);
    std::atomic<bool> other_came = false;
    listeners.post([&other_came] { other_came.wait(false); });
    listeners.post([&other_came] {
        other_came = true;
        other_came.notify_all();
    });
    listeners.join();
    EXPECT_TRUE(other_came);
}

}  // namespace
}  // namespace echoloop
