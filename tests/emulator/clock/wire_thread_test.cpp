// That the thread of the wires can be fetched to a processor that runs, and that its timers ring there. A
// host that takes a processor away cannot be had for a test: TEST DOUBLE of timerfd_settime(), whose timers,
// where a test asks for it, do not ring unless they are over when they are set, as if the processor that
// keeps them stood still.
#include "emulator/machine/wire_thread.h"

#include <gtest/gtest.h>
#include <sys/syscall.h>
#include <sys/timerfd.h>
#include <unistd.h>

#include <atomic>
#include <boost/asio/detached.hpp>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "emulator/clock/clock.h"
#include "tests/emulator/clock/watched.h"

namespace {
std::atomic<bool> timers_stand_still{false};
}

extern "C" int timerfd_settime(int timer, int flags, const itimerspec* wanted, itimerspec* before) noexcept {
    constexpr itimerspec never{};
    if (timers_stand_still && (flags & TFD_TIMER_ABSTIME) == 0) wanted = &never;
    return static_cast<int>(::syscall(SYS_timerfd_settime, timer, flags, wanted, before));
}

namespace echoloop {
namespace {

using namespace std::chrono_literals;
using Steady = WireThread::Steady;

constexpr auto long_since = 10s;  ///< for a machine with other things to do

class Standing {
  public:
    Standing() { timers_stand_still = true; }
    ~Standing() { timers_stand_still = false; }
};

/// The 39th field of proc(5)'s stat.
int last_processor_of(pid_t thread) {
    std::ifstream file("/proc/self/task/" + std::to_string(thread) + "/stat");
    const std::string stat{std::istreambuf_iterator<char>(file), {}};
    std::istringstream rest(stat.substr(stat.rfind(") ") + 2));
    std::string field;
    for (int i = 3; i <= 39; ++i) rest >> field;
    return std::stoi(field);
}

template <typename Condition>
bool comes_true(const Condition& condition) {
    for (const auto end = Steady::now() + long_since; Steady::now() < end; std::this_thread::yield())
        if (condition()) return true;
    return false;
}

/// A thread that sleeps in an io_context until it is told to end.
class SleepingThread {
  public:
    SleepingThread() {
        thread_ = std::jthread([this] {
            WireThread here(io_);
            id_ = ::gettid();
            wire_thread_ = &here;
            io_.run();
        });
        while (wire_thread_ == nullptr) std::this_thread::yield();
    }
    ~SleepingThread() { io_.stop(); }
    WireThread& wire_thread() { return *wire_thread_; }
    pid_t id() const { return id_; }
    asio::io_context& io() { return io_; }

  private:
    asio::io_context io_;
    std::atomic<WireThread*> wire_thread_{nullptr};
    std::atomic<pid_t> id_{0};
    std::jthread thread_;
};

TEST(WireThreads, StayOnTheProcessorThatFetchesThemAndMayInTheEndRunWhereverTheyMightBefore) {
    const auto all = processors_of(0);
    SleepingThread thread;
    EXPECT_EQ(processors_of(thread.id()).size(), 1u) << "from the beginning";
    constexpr int times = 20;
    for (const int processor : all) {
        for (int i = 0; i < times; ++i) {
            ASSERT_TRUE(comes_true([&] { return thread.wire_thread().state().asleep; }));
            thread.wire_thread().fetch_to(processor);
            ASSERT_TRUE(comes_true([&] { return last_processor_of(thread.id()) == processor; }));
            EXPECT_EQ(processors_of(thread.id()), std::vector{processor});
        }
    }
    {
        asio::io_context io;
        const WireThread here(io);
        EXPECT_EQ(processors_of(0).size(), 1u);
    }
    EXPECT_EQ(processors_of(0), all);
}

TEST(WireThreads, TellWhereTheyWork) {
    SleepingThread thread;
    std::atomic<bool> working{false}, enough{false};
    asio::post(thread.io(), [&] {
        for (working = true; !enough;) continue;
    });
    ASSERT_TRUE(comes_true([&] { return working.load(); }));
    EXPECT_FALSE(thread.wire_thread().state().asleep);
    for (const int processor : processors_of(0)) {
        thread.wire_thread().fetch_to(processor);  // which waits until it is there
        EXPECT_EQ(thread.wire_thread().state().processor, processor);
    }
    enough = true;
}

TEST(WireThreads, RingTimersThatAreOverWhenTheyAreFetched) {
    const Standing still;
    SleepingThread thread;
    std::atomic<bool> set{false}, early{false}, later{false};
    asio::steady_timer first(thread.io()), second(thread.io());
    asio::post(thread.io(), [&] {
        first.expires_after(1ms);
        first.async_wait([&](error_code ec) { early = !ec; });
        second.expires_after(1h);
        second.async_wait([&](error_code ec) { later = !ec; });
        set = true;
    });
    ASSERT_TRUE(comes_true([&] { return set.load(); }));
    const auto over = Steady::now() + 1ms;
    ASSERT_TRUE(comes_true([&] { return Steady::now() > over; }));
    EXPECT_FALSE(early) << "the double does not keep it from ringing";
    thread.wire_thread().fetch_to(processors_of(0).front());
    EXPECT_TRUE(comes_true([&] { return early.load(); }));
    EXPECT_FALSE(later);
}

/// A clock whose thread is looked after.
class LookedAfterClocks : public Watched {
  protected:
    void SetUp() override {
        Watched::SetUp();
        if (watching) clock.watch(&*watching);
    }

    asio::io_context io;
    RealClock clock{io};
};

TEST_F(LookedAfterClocks, RingTheirAlarmsThoughTheTimerBehindThemDoesNot) {
    std::vector<std::string> order;
    const auto wake = [&](std::string name, Alarm& alarm, Time when) -> Task<void> {
        co_await alarm.until(when);
        EXPECT_GE(clock.now(), when) << name;
        order.push_back(name);
        if (name == "last") io.stop();
    };
    Alarm a(clock), b(clock), c(clock), d(clock);
    const auto spawn = [&](const char* name, Alarm& alarm, Time when) {
        asio::co_spawn(io, wake(name, alarm, when), asio::detached);
    };
    const auto sets_the_next = [&]() -> Task<void> {
        Alarm nearer(clock);
        co_await nearer.until(10ms);
        order.push_back("before");
        c.cancel();  // not to be waited for
        co_await nearer.until(15ms);
        order.push_back("second");
    };
    spawn("third", a, 20ms);
    spawn("first", b, 5ms);
    asio::co_spawn(
        io,
        [&]() -> Task<void> {
            co_await c.until(1h);
            order.push_back("cancelled");
        },
        asio::detached);
    spawn("last", d, 30ms);
    asio::co_spawn(io, sets_the_next(), asio::detached);
    std::jthread giving_up([this](const std::stop_token& ended) {
        const auto end = Steady::now() + long_since;
        while (!ended.stop_requested() && Steady::now() < end) std::this_thread::sleep_for(10ms);
        io.stop();
    });
    {
        const Standing still;
        clock.run();
    }
    giving_up.request_stop();
    EXPECT_EQ(order, (std::vector<std::string>{"first", "before", "cancelled", "second", "third", "last"}));
    EXPECT_GE(watching->summary().fetched, 5u);
}

TEST_F(LookedAfterClocks, AreLeftInPeaceWhenNothingIsDue) {
    Alarm soon(clock), rung(clock), cancelled(clock), far(clock);
    const auto wait = [](Alarm& alarm, Time when) -> Task<void> { co_await alarm.until(when); };
    asio::co_spawn(io, wait(rung, 2ms), asio::detached);
    asio::co_spawn(io, wait(cancelled, 3ms), asio::detached);
    asio::co_spawn(io, wait(far, 1h), asio::detached);
    asio::co_spawn(
        io,
        [&]() -> Task<void> {
            co_await soon.until(1ms);
            cancelled.cancel();
            co_await soon.until(400ms);
            io.stop();
        },
        asio::detached);
    clock.run();
    EXPECT_LT(watching->summary().fetched, 300u) << "3000 if one that rang or was cancelled were still due";
}

}  // namespace
}  // namespace echoloop
