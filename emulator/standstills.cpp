#include "emulator/standstills.h"

#include <pthread.h>
#include <sched.h>

#include <algorithm>
#include <array>
#include <future>
#include <mutex>
#include <thread>

#include "emulator/punctual.h"

namespace echoloop {
namespace {

using namespace std::chrono_literals;

constexpr auto period = 1ms;
constexpr auto punctual = 300us;  ///< nobody's pings are late for less

void stay_on(int processor) {
    cpu_set_t only;
    CPU_ZERO(&only);
    CPU_SET(processor, &only);
    ::pthread_setaffinity_np(::pthread_self(), sizeof only, &only);
}

std::vector<int> usable_processors() {
    cpu_set_t mine;
    CPU_ZERO(&mine);
    std::vector<int> usable;
    if (::sched_getaffinity(0, sizeof mine, &mine) != 0) return usable;
    for (int processor = 0; processor < CPU_SETSIZE; ++processor)
        if (CPU_ISSET(processor, &mine)) usable.push_back(processor);
    return usable;
}

}  // namespace

/// Of one processor.
class Standstills::Watcher {
  public:
    explicit Watcher(int processor) {
        std::promise<void> ready;
        auto outcome = ready.get_future();
        thread_ = std::jthread([this, processor, &ready](const std::stop_token& stop) {
            stay_on(processor);
            try {
                claim_real_time(Turn::watchers);
            } catch (...) {
                return ready.set_exception(std::current_exception());
            }
            next_ = Steady::now() + period;
            ready.set_value();
            watch(stop);
        });
        outcome.get();
    }

    Steady::duration within(Steady::time_point from, Steady::time_point to) const {
        const std::lock_guard lock(mutex_);
        Steady::duration sum{};
        for (const Standstill& one : last_) sum += one.within(from, to);
        if (to > next_ + punctual) sum += Standstill{next_, to}.within(from, to);  // it has not come yet
        return sum;
    }

    Summary summary() const {
        const std::lock_guard lock(mutex_);
        return summary_;
    }

  private:
    struct Standstill {
        Steady::time_point from{}, to{};
        Steady::duration within(Steady::time_point begin, Steady::time_point end) const {
            return std::max(Steady::duration{}, std::min(to, end) - std::max(from, begin));
        }
    };

    void watch(const std::stop_token& stop) {
        while (!stop.stop_requested()) {
            std::this_thread::sleep_until(next_);
            const auto now = Steady::now();
            const std::lock_guard lock(mutex_);
            if (now - next_ > punctual) keep({next_, now});
            next_ = now + period;
        }
    }

    void keep(Standstill one) {
        last_[summary_.count++ % last_.size()] = one;
        summary_.longest = std::max(summary_.longest, one.to - one.from);
    }

    mutable std::mutex mutex_;
    std::array<Standstill, 64> last_{};
    Summary summary_;
    Steady::time_point next_{};  ///< written under the mutex, by the thread alone
    std::jthread thread_;        // last: ended first
};

Standstills::Standstills() {
    for (const int processor : usable_processors()) watchers_.push_back(std::make_unique<Watcher>(processor));
}

Standstills::~Standstills() = default;

Standstills::Steady::duration Standstills::within(Steady::time_point from, Steady::time_point to) const {
    Steady::duration longest{};
    for (const auto& watcher : watchers_) longest = std::max(longest, watcher->within(from, to));
    return longest;
}

Standstills::Summary Standstills::summary() const {
    Summary all;
    for (const auto& watcher : watchers_) {
        const Summary one = watcher->summary();
        all.count += one.count;
        all.longest = std::max(all.longest, one.longest);
    }
    return all;
}

}  // namespace echoloop
