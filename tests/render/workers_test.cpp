// Threads that help with a loop, and how they take turns with other programs.
#include "render/workers.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sched.h>

#include <barrier>
#include <mutex>

namespace echoloop {
namespace {

/// Of every thread that took part in a loop with one piece for each.
std::vector<int> policies(Workers& workers, std::size_t threads) {
    std::barrier everyone(static_cast<std::ptrdiff_t>(threads));
    std::mutex mutex;
    std::vector<int> found;
    workers.run(threads, [&](std::size_t) {
        everyone.arrive_and_wait();  // nobody takes two pieces
        const std::lock_guard lock(mutex);
        found.push_back(::sched_getscheduler(0));
    });
    return found;
}

void take_turns_as(int policy) {
    const sched_param none{};
    ASSERT_EQ(::sched_setscheduler(0, policy, &none), 0);
}

TEST(HelpingThreads, TakeTurnsWithOtherProgramsAsTheCallerDoes) {
    using testing::Each;
    Workers workers(3);
    EXPECT_THAT(policies(workers, 3), Each(SCHED_OTHER));
    take_turns_as(SCHED_BATCH);
    EXPECT_THAT(policies(workers, 3), Each(SCHED_BATCH)) << "they had begun before the caller changed";
    take_turns_as(SCHED_OTHER);
    EXPECT_THAT(policies(workers, 3), Each(SCHED_OTHER));
}

}  // namespace
}  // namespace echoloop
