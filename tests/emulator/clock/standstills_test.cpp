// What is told of processors that stand still. Here a thread more urgent than any watcher keeps them, which
// to all others is the same as a host that takes them away.
#include "emulator/machine/standstills.h"

#include <gtest/gtest.h>
#include <pthread.h>
#include <sched.h>

#include <algorithm>
#include <future>
#include <vector>

#include "tests/emulator/clock/watched.h"

namespace echoloop {
namespace {

using namespace std::chrono_literals;
using Steady = Standstills::Steady;

/// When it has the processor to itself, and how long it keeps that.
struct Kept {
    Steady::time_point from, to;
};

Kept keep_for(int processor, Steady::duration time) {
    cpu_set_t only;
    CPU_ZERO(&only);
    CPU_SET(processor, &only);
    ::pthread_setaffinity_np(::pthread_self(), sizeof only, &only);
    sched_param most_urgent{.sched_priority = 99};
    EXPECT_EQ(::pthread_setschedparam(::pthread_self(), SCHED_FIFO, &most_urgent), 0);
    const auto from = Steady::now(), end = from + time;
    auto to = from;
    while (to < end) to = Steady::now();
    return {from, to};
}

constexpr auto kept = 60ms;

class ProcessorsThatStandStill : public Watched {
  protected:
    /// All of them from `begin` to `end`, and some a little longer.
    void keep(const std::vector<int>& processors, Steady::duration time = kept) {
        std::vector<std::future<Kept>> all;
        for (const int processor : processors)
            all.push_back(std::async(std::launch::async, keep_for, processor, time));
        begin = Steady::time_point::min();
        end = Steady::time_point::max();
        for (auto& one : all) {
            const Kept times = one.get();
            begin = std::max(begin, times.from);
            end = std::min(end, times.to);
        }
    }

    Steady::time_point begin, end;
};

TEST_F(ProcessorsThatStandStill, AreToldIfItIsOneOfThem) {
    const auto processors = processors_of(0);
    if (processors.size() < 2) GTEST_SKIP() << "this machine has one processor, so one is all";
    for (const int processor : {processors.front(), processors.back()}) {
        keep({processor});
        const auto one = watching->within(begin, end);
        EXPECT_EQ(one, end - begin) << "processor " << processor;
        EXPECT_LT(watching->of_all_within(begin, end), one / 2) << "another one ran";
        EXPECT_EQ(watching->within(begin, begin + kept / 2), kept / 2) << "no more than was asked for";
    }
}

TEST_F(ProcessorsThatStandStill, AreToldIfItIsAllOfThem) {
    keep(processors_of(0));
    EXPECT_EQ(watching->of_all_within(begin, end), end - begin);
    EXPECT_EQ(watching->of_all_within(begin, begin + kept / 2), kept / 2) << "no more than was asked for";
}

// Whatever the watcher does when its processor is taken: else a ping that came too late for that is laid at
// somebody else's door.
TEST_F(ProcessorsThatStandStill, AreToldFromTheMomentOnThatTheyDo) {
    for (int i = 0; i < 200; ++i) {
        keep({processors_of(0).back()}, 2ms);
        EXPECT_EQ(watching->within(begin, end), end - begin) << "the " << i << "th time";
    }
}

TEST_F(ProcessorsThatStandStill, AreNoneBeforeAnybodyWatches) {
    keep(processors_of(0));
    EXPECT_EQ(watching->within(begin - 2s, begin - 1s), 0s);
    EXPECT_EQ(watching->of_all_within(begin - 2s, begin - 1s), 0s);
}

}  // namespace
}  // namespace echoloop
