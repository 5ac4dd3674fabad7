// Time that is moved on from outside: who is woken when, in which order, and what time waits for. Nothing
// here sleeps.
#include "emulator/clock/stepped_clock.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <boost/asio/post.hpp>
#include <chrono>
#include <thread>

namespace echoloop {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;

class SteppedClockTest : public testing::Test {
  protected:
    /// Writes down `name` and the time when an alarm for `when` rings.
    Task<void> note(Alarm& alarm, Time when, std::string name) {
        co_await alarm.until(when);
        notes_.push_back(name + " " + std::to_string(clock_.now() / 1ms));
    }
    void expect(Alarm& alarm, Time when, std::string name) {
        asio::co_spawn(io_, note(alarm, when, std::move(name)), Serving("test"));
    }
    /// Makes these steps, one after the other, and returns.
    void step(std::vector<Time> times) {
        asio::co_spawn(
            io_,
            [this, times]() -> Task<void> {
                for (const Time time : times) {
                    co_await clock_.step(time);
                    notes_.push_back("step " + std::to_string(clock_.now() / 1ms));
                }
                io_.stop();
            },
            Serving("test"));
        io_.restart();
        clock_.run();
    }

    asio::io_context io_;
    asio::executor_work_guard<asio::io_context::executor_type> work_ = asio::make_work_guard(io_);
    SteppedClock clock_{io_};
    std::vector<std::string> notes_;
};

TEST_F(SteppedClockTest, AlarmsRingAtTheirOwnTimes) {
    Alarm late(clock_), early(clock_), later(clock_);
    expect(late, 90ms, "late");
    expect(early, 10ms, "early");
    expect(later, 100ms + 1ns, "later");
    step({100ms});
    EXPECT_THAT(notes_, ElementsAre("early 10", "late 90", "step 100"));
    step({101ms});
    EXPECT_EQ(notes_[3], "later 100");
}

TEST_F(SteppedClockTest, EqualTimesKeepTheOrderOfRanksAndThenOfSetting) {
    Alarm first(clock_, 1), second(clock_, 2), third(clock_, 2);
    expect(third, 5ms, "third");
    expect(second, 5ms, "second");
    expect(first, 5ms, "first");
    step({5ms});
    EXPECT_THAT(notes_, ElementsAre("first 5", "third 5", "second 5", "step 5"));
}

TEST_F(SteppedClockTest, TimeStandsStillBetweenSteps) {
    Alarm alarm(clock_);
    step({20ms});
    EXPECT_EQ(clock_.now(), 20ms);
    expect(alarm, 20ms, "at once");  // what is due at the time that it is needs no step
    expect(alarm, 20ms, "at once");
    asio::post(io_, [this] { asio::post(io_, [this] { io_.stop(); }); });
    io_.restart();
    clock_.run();
    EXPECT_EQ(clock_.now(), 20ms);
    EXPECT_EQ(notes_[1], "at once 20");
}

TEST_F(SteppedClockTest, WhoWaitsSecondOnAnAlarmWakesTheFirst) {
    Alarm alarm(clock_);
    expect(alarm, 10ms, "first");
    expect(alarm, 50ms, "second");
    step({5ms, 100ms});
    EXPECT_THAT(notes_, ElementsAre("first 0", "step 5", "second 50", "step 100"));
}

TEST_F(SteppedClockTest, ACancelledAlarmWakesItsCoroutineAtTheTimeOfTheCancel) {
    Alarm alarm(clock_), other(clock_);
    expect(alarm, 50ms, "woken");
    asio::co_spawn(
        io_,
        [&]() -> Task<void> {
            co_await other.until(30ms);
            alarm.cancel();
        },
        Serving("test"));
    step({100ms});
    EXPECT_THAT(notes_, ElementsAre("woken 30", "step 100"));
}

TEST_F(SteppedClockTest, TimeWaitsForWhatAnotherThreadOwesIt) {
    Alarm due(clock_), next(clock_), answer(clock_);
    std::jthread renderer;
    asio::co_spawn(
        io_,
        [&]() -> Task<void> {
            co_await due.until(10ms);
            const Clock::Hold hold(clock_);
            bool there = false;
            renderer = std::jthread([&] {
                asio::post(io_, [&] {
                    there = true;
                    answer.cancel();
                });
            });
            while (!there) co_await answer.until(Time::max());
            notes_.push_back("rendered " + std::to_string(clock_.now() / 1ms));
        },
        Serving("test"));
    expect(next, 11ms, "next");
    step({20ms});
    EXPECT_THAT(notes_, ElementsAre("rendered 10", "next 11", "step 20"));
}

TEST_F(SteppedClockTest, WhatComesDuringAStepWaitsForItsEnd) {
    Alarm alarm(clock_);
    clock_.on_step([this](Time to) { notes_.push_back("to " + std::to_string(to / 1ms)); });
    asio::co_spawn(
        io_,
        [&]() -> Task<void> {
            co_await alarm.until(10ms);
            EXPECT_TRUE(clock_.stepping());
            clock_.later([this] { notes_.push_back("behind " + std::to_string(clock_.now() / 1ms)); });
        },
        Serving("test"));
    step({20ms, 30ms});
    EXPECT_THAT(notes_, ElementsAre("to 20", "behind 20", "step 20", "to 30", "step 30"));
    EXPECT_FALSE(clock_.stepping());
}

TEST_F(SteppedClockTest, AnAlarmMayBeGoneBeforeItRingsOrOutliveTheClock) {
    auto clock = std::make_unique<SteppedClock>(io_);
    auto outlives = std::make_unique<Alarm>(*clock);
    {
        Alarm gone(*clock);
        expect(*outlives, 10ms, "never");
        expect(gone, 10ms, "early");
        io_.poll();  // both wait
    }
    io_.poll();
    EXPECT_THAT(notes_, ElementsAre("early 0"));
    clock.reset();
    outlives.reset();
}

TEST(RealClock, GoesAsFastAsItsRate) {
    asio::io_context io;
    RealClock slow(io, 1), fast(io, 1000);
    Alarm alarm(fast);
    asio::co_spawn(io, alarm.until(2s), Serving("test"));
    fast.begin();
    slow.begin();
    io.run();
    EXPECT_GE(fast.now(), 2s);
    EXPECT_GE(slow.now(), 2ms);
    EXPECT_LT(slow.now(), 1s);
}

}  // namespace
}  // namespace echoloop
