// Threads that share out loops: every piece is done once, whoever does it, and what is thrown arrives.
#include "render/workers.h"

#include <gtest/gtest.h>

#include <atomic>
#include <optional>
#include <set>
#include <stdexcept>

namespace echoloop {
namespace {

class WorkersOf : public testing::TestWithParam<std::size_t> {
  protected:
    Workers workers_{GetParam()};
};

/// How often each of `count` pieces was done, in `rounds` loops one right after the other.
std::vector<int> times_done(Workers& workers, std::size_t count, int rounds) {
    std::vector<std::atomic<int>> times(count);
    for (int i = 0; i < rounds; ++i) workers.run(count, [&](std::size_t piece) { ++times[piece]; });
    return {times.begin(), times.end()};
}

TEST_P(WorkersOf, DoEveryPieceOnceInEveryLoop) {
    EXPECT_EQ(times_done(workers_, 37, 500), std::vector<int>(37, 500));
    const Workers::Burst burst(workers_);
    EXPECT_EQ(times_done(workers_, 37, 500), std::vector<int>(37, 500)) << "while threads look for more";
}

/// Until another thread has said so.
void await(const std::atomic<bool>& said) {
    while (!said) std::this_thread::yield();
}

/// Long enough for who does not wait to be gone.
void dawdle() {
    for (int i = 0; i < 20; ++i) std::this_thread::yield();
}

TEST_P(WorkersOf, AreNoMoreThanAsked) {
    if (GetParam() < 3) return;
    std::atomic<std::size_t> greatest{0};
    for (int i = 0; i < 20; ++i) {
        std::atomic<bool> others{false};
        const auto work = [&](std::size_t) {
            const std::size_t number = Workers::number();
            if (number > greatest) greatest = number;
            if (number > 0) others = true;
            await(others);
        };
        workers_.run(2, work, 2);
    }
    EXPECT_EQ(greatest, 1U);
}

TEST_P(WorkersOf, HaveAllEndedWhenALoopReturns) {
    if (GetParam() < 2) return;
    for (int i = 0; i < 20; ++i) {
        std::atomic<bool> begun{false}, ended{false};
        workers_.run(2, [&](std::size_t) {
            if (Workers::number() == 0) return await(begun);
            begun = true;
            dawdle();
            ended = true;
        });
        ASSERT_TRUE(ended);
    }
}

TEST_P(WorkersOf, PassOnWhatAPieceThrows) {
    const auto fail = [](std::size_t piece) {
        if (piece == 7) throw std::runtime_error("seven");
    };
    EXPECT_THROW(workers_.run(20, fail), std::runtime_error);
    EXPECT_EQ(times_done(workers_, 20, 1), std::vector<int>(20, 1)) << "and go on";
}

TEST_P(WorkersOf, DoWhatIsAsideOnceBesideLoops) {
    const Workers::Burst burst(workers_);
    int aside_done = 0;
    for (int i = 0; i < 300; ++i) {
        Workers::Aside aside(workers_, [&] { ++aside_done; });
        EXPECT_EQ(times_done(workers_, 5, 2), std::vector<int>(5, 2));
        aside.wait();
        ASSERT_EQ(aside_done, i + 1);
    }
}

TEST_P(WorkersOf, PassOnWhatIsThrownAside) {
    Workers::Aside aside(workers_, [] { throw std::runtime_error("aside"); });
    EXPECT_THROW(aside.wait(), std::runtime_error);
}

TEST_P(WorkersOf, WaitForWhatIsAsideBeforeItsMemoryGoes) {
    if (GetParam() < 2) return;
    for (int i = 0; i < 20; ++i) {
        std::atomic<bool> begun{false}, ended{false};
        {
            const Workers::Aside aside(workers_, [&] {
                begun = true;
                dawdle();
                ended = true;
            });
            await(begun);
        }
        ASSERT_TRUE(ended);
    }
}

TEST(WorkersAlone, DropWhatIsAsideAndNotWaitedFor) {
    Workers workers(1);
    bool done = false;
    {
        const Workers::Aside aside(workers, [&] { done = true; });
    }
    EXPECT_FALSE(done);
}

TEST_P(WorkersOf, AreVisitedOnTheirOwnThreads) {
    workers_.run(GetParam(), [](std::size_t) {});
    std::set<std::size_t> numbers;  // visits come one at a time
    std::set<std::thread::id> threads;
    workers_.visit([&](std::size_t number) {
        EXPECT_EQ(number, Workers::number());
        numbers.insert(number), threads.insert(std::this_thread::get_id());
    });
    EXPECT_EQ(numbers.size(), GetParam() - 1);
    EXPECT_EQ(threads.size(), GetParam() - 1);
    EXPECT_FALSE(threads.contains(std::this_thread::get_id()));
}

INSTANTIATE_TEST_SUITE_P(Each, WorkersOf, testing::Values(1, 2, 3, 7));

}  // namespace
}  // namespace echoloop
