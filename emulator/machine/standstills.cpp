#include "emulator/machine/standstills.h"

#include <pthread.h>
#include <sched.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <future>
#include <mutex>
#include <thread>

#include "emulator/machine/punctual.h"
#include "emulator/machine/wire_thread.h"

namespace echoloop {
namespace {

using namespace std::chrono_literals;

constexpr auto period = 1ms;
constexpr auto punctual = 300us;  ///< nobody's pings are late for less
constexpr auto awake = 1h;        ///< a watcher that has come stands nowhere still, however long it works
constexpr auto rest = 400us;      ///< at least, between two looks: with `patience` within a millisecond
constexpr auto patience = 250us;  ///< timers and the threads they wake may take that long

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

struct Stretch {
    Standstills::Steady::time_point from{}, to{};
    Standstills::Steady::duration length() const { return to - from; }
    Stretch in(const Stretch& other) const { return {std::max(from, other.from), std::min(to, other.to)}; }
};

Standstills::Steady::duration sum(const std::vector<Stretch>& stretches) {
    Standstills::Steady::duration sum{};
    for (const Stretch& one : stretches) sum += one.length();
    return sum;
}

/// What is in both; neither's stretches overlap each other.
std::vector<Stretch> common(const std::vector<Stretch>& some, const std::vector<Stretch>& others) {
    std::vector<Stretch> both;
    for (const Stretch& one : some)
        for (const Stretch& other : others)
            if (const Stretch in = one.in(other); in.from < in.to) both.push_back(in);
    return both;
}

}  // namespace

/// Of one processor.
class Standstills::Watcher {
  public:
    Watcher(const Standstills& all, int processor) : all_(all), processor_(processor) {
        std::promise<void> ready;
        auto outcome = ready.get_future();
        thread_ = std::jthread([this, &ready](const std::stop_token& stop) {
            stay_on(processor_);
            try {
                claim_real_time(Turn::watchers);
            } catch (...) {
                return ready.set_exception(std::current_exception());
            }
            ran_ = Steady::now();
            next_ = ran_.load() + period;
            ready.set_value();
            watch(stop);
        });
        outcome.get();
    }

    std::vector<Stretch> within(const Stretch& asked) const {
        const std::lock_guard lock(mutex_);
        std::vector<Stretch> found(last_.begin(), last_.end());
        if (asked.to > next_.load() + punctual) found.push_back({ran_, asked.to});  // it has not come yet
        return common(found, {asked});
    }

    /// Takes no lock, which a watcher that stands still might hold.
    bool stands_still(Steady::time_point now) const { return now > next_.load() + punctual; }
    int processor() const { return processor_; }

    Summary summary() const {
        const std::lock_guard lock(mutex_);
        Summary summary = summary_;
        summary.fetched = fetched_;
        return summary;
    }

    void look_after(WireThread* thread) {
        const std::lock_guard lock(care_);
        wire_thread_ = thread;
    }

  private:
    void watch(const std::stop_token& stop) {
        while (!stop.stop_requested()) {
            const Steady::time_point due = next_;
            std::this_thread::sleep_until(due);
            const auto now = Steady::now();
            note(due, now);
            if (fetch(now)) ++fetched_;
            next_ = next_wake();
        }
    }

    void note(Steady::time_point due, Steady::time_point now) {
        const std::lock_guard lock(mutex_);
        if (now - due > punctual) keep({ran_, now});
        next_ = now + awake;
    }

    bool fetch(Steady::time_point now) {
        const std::lock_guard lock(care_);
        if (wire_thread_ == nullptr || now < overdue()) return false;
        const auto state = wire_thread_->state();
        if (!state.asleep && (state.processor == processor_ || !all_.stands_still(state.processor, now)))
            return false;
        wire_thread_->fetch_to(processor_);
        return true;
    }

    Steady::time_point next_wake() {
        const auto now = Steady::now();
        ran_ = now;
        const std::lock_guard lock(care_);
        return wire_thread_ == nullptr ? now + period : std::clamp(overdue(), now + rest, now + period);
    }

    /// When the thread should have woken long since.
    Steady::time_point overdue() const {
        const auto due = wire_thread_->due();
        return due == Steady::time_point::max() ? due : due + patience;
    }

    void keep(const Stretch& one) {
        last_[summary_.count++ % last_.size()] = one;
        summary_.longest = std::max(summary_.longest, one.length());
    }

    const Standstills& all_;
    int processor_;
    std::mutex care_;  ///< of no use to other threads, but when a thread comes or goes
    WireThread* wire_thread_ = nullptr;
    mutable std::mutex mutex_;
    std::array<Stretch, 64> last_{};
    Summary summary_;
    std::atomic<std::uint64_t> fetched_{0};
    std::atomic<Steady::time_point> ran_{};   ///< when its processor is known to have run last
    std::atomic<Steady::time_point> next_{};  ///< when it means to wake
    std::jthread thread_;                     // last: ended first
};

Standstills::Standstills() {
    for (const int processor : usable_processors())
        watchers_.push_back(std::make_unique<Watcher>(*this, processor));
}

Standstills::~Standstills() = default;

Standstills::Steady::duration Standstills::within(Steady::time_point from, Steady::time_point to) const {
    Steady::duration longest{};
    for (const auto& watcher : watchers_) longest = std::max(longest, sum(watcher->within({from, to})));
    return longest;
}

Standstills::Steady::duration Standstills::of_all_within(Steady::time_point from,
                                                         Steady::time_point to) const {
    std::vector<Stretch> all{{from, to}};
    for (const auto& watcher : watchers_) all = common(all, watcher->within({from, to}));
    return sum(all);
}

Standstills::Summary Standstills::summary() const {
    Summary all;
    for (const auto& watcher : watchers_) {
        const Summary one = watcher->summary();
        all.count += one.count;
        all.longest = std::max(all.longest, one.longest);
        all.fetched += one.fetched;
    }
    return all;
}

bool Standstills::stands_still(int processor, Steady::time_point now) const {
    return std::ranges::any_of(watchers_, [&](const auto& watcher) {
        return watcher->processor() == processor && watcher->stands_still(now);
    });
}

void Standstills::look_after(WireThread* thread) {
    for (const auto& watcher : watchers_) watcher->look_after(thread);
}

Standstills::Care::Care(Standstills& standstills, WireThread& thread) : standstills_(standstills) {
    standstills_.look_after(&thread);
}

Standstills::Care::~Care() { standstills_.look_after(nullptr); }

}  // namespace echoloop
