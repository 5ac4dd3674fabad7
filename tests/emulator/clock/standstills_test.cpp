// What is told of processors that stand still. Here a thread more urgent than any watcher keeps them, which
// to all others is the same as a host that takes them away.
#include "emulator/standstills.h"

#include <gtest/gtest.h>
#include <pthread.h>
#include <sched.h>

#include <thread>
#include <vector>

#include "tests/emulator/clock/watched.h"

namespace echoloop {
namespace {

using namespace std::chrono_literals;
using Steady = Standstills::Steady;

void keep_until(int processor, Steady::time_point end) {
    cpu_set_t only;
    CPU_ZERO(&only);
    CPU_SET(processor, &only);
    ::pthread_setaffinity_np(::pthread_self(), sizeof only, &only);
    sched_param most_urgent{.sched_priority = 99};
    ASSERT_EQ(::pthread_setschedparam(::pthread_self(), SCHED_FIFO, &most_urgent), 0);
    while (Steady::now() < end) continue;
}

constexpr auto kept = 60ms;
constexpr auto seen = 20ms;  ///< the rest is for threads to begin, and for other things the machine does

class ProcessorsThatStandStill : public Watched {
  protected:
    void keep(const std::vector<int>& processors) {
        begin = Steady::now();
        std::vector<std::jthread> threads;
        for (const int processor : processors) threads.emplace_back(keep_until, processor, begin + kept);
        threads.clear();
        end = Steady::now();
    }

    Steady::time_point begin, end;
};

TEST_F(ProcessorsThatStandStill, AreToldIfItIsOneOfThem) {
    const auto processors = processors_of(0);
    if (processors.size() < 2) GTEST_SKIP() << "this machine has one processor, so one is all";
    for (const int processor : {processors.front(), processors.back()}) {
        keep({processor});
        const auto one = watching->within(begin, end);
        EXPECT_GE(one, seen) << "processor " << processor;
        EXPECT_LT(watching->of_all_within(begin, end), one / 2) << "another one ran";
        EXPECT_LE(watching->within(begin, begin + kept / 2), kept / 2) << "no more than was asked for";
    }
}

TEST_F(ProcessorsThatStandStill, AreToldIfItIsAllOfThem) {
    keep(processors_of(0));
    EXPECT_GE(watching->of_all_within(begin, end), seen);
    EXPECT_LE(watching->of_all_within(begin, end), watching->within(begin, end));
    EXPECT_LE(watching->of_all_within(begin, begin + kept / 2), kept / 2) << "no more than was asked for";
}

TEST_F(ProcessorsThatStandStill, AreNoneBeforeAnybodyWatches) {
    keep(processors_of(0));
    EXPECT_EQ(watching->within(begin - 2s, begin - 1s), 0s);
    EXPECT_EQ(watching->of_all_within(begin - 2s, begin - 1s), 0s);
}

}  // namespace
}  // namespace echoloop
