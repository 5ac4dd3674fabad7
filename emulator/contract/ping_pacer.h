// When a sonar that pings by itself sends the next ping, and how a ping's datagrams are spread over time. One
// ping at a time, not sooner than the interval after the last one. Sets no timer of its own: the device wakes
// at wake().
#pragma once

#include <algorithm>
#include <optional>
#include <span>

#include "emulator/contract/device.h"
#include "emulator/contract/sensors.h"

namespace echoloop {

class PingPacer {
  public:
    PingPacer() = default;
    /// Pings come as late as the unit's timer has it. The pings behind keep their places.
    PingPacer(const Sensors& timer, const Jitter& jitter) : timer_(timer), jitter_(jitter) {}

    /// Pings from now on, behind the one under way, and `interval` behind the last one. Also where the
    /// interval has changed.
    void start(Time now, Time interval) {
        wanted_ = true;
        if (!under_way_) next_ = std::max(now, after_last(interval));
    }
    /// No more pings; the one under way is heard all the same.
    void pause() {
        wanted_ = false;
        next_ = Time::max();
    }
    /// No more pings, and the one under way is not heard.
    void stop() {
        pause();
        under_way_ = false;
    }
    /// As new: no ping was ever sent.
    void reset() { *this = PingPacer(timer_, jitter_); }
    /// The next ping, if one is planned, waits until then at least.
    void hold(Time until) {
        if (next_ != Time::max()) next_ = std::max(next_, until);
    }
    /// True if a ping goes out now; end() must follow.
    bool begin(Time now) {
        if (under_way_ || now < next_) return false;
        late_ = began_ ? lateness() : Time{};
        began_ = next_;  // as planned, so that late wake-ups do not add up
        ++pings_;
        next_ = Time::max();
        under_way_ = true;
        return true;
    }
    /// The ping was heard, and the next one follows if one is wanted. False if it was given up.
    bool end(Time now, Time interval) {
        if (!under_way_) return false;
        under_way_ = false;
        ended_ = now;
        next_ = wanted_ ? after_last(interval) : Time::max();
        return true;
    }
    /// After the ping under way, no other.
    void once() { wanted_ = false; }

    Time wake() const { return next_; }
    bool under_way() const { return under_way_; }
    /// When the last ping began, as planned; empty before the first.
    std::optional<Time> began() const { return began_; }

  private:
    Time lateness() const { return timer_.lateness(jitter_, pings_); }
    Time after_last(Time interval) const {
        return began_ ? std::max(*began_ - late_ + interval, ended_) + lateness() : Time{};
    }

    Sensors timer_;
    Jitter jitter_;
    std::uint64_t pings_ = 0;  ///< begun
    Time late_{};              ///< of the last one

    bool wanted_ = false, under_way_ = false;
    Time next_ = Time::max(), ended_{};
    std::optional<Time> began_;
};

/// Datagrams that leave at once, so that nobody is woken for each: those of so long, and of so many bytes.
struct Batch {
    Time time{};
    std::size_t bytes = 0;
};

/// Spreads datagrams over time, since receivers lose bursts: the first at `from`, each `gap` behind the one
/// before, or closer where the last would come after `until`. Returns when the next one may go.
inline Time spread(std::span<Send> datagrams, Time from, Time gap, Time until, Batch batch = {}) {
    const auto count = static_cast<Time::rep>(datagrams.size());
    if (count == 0) return from;
    gap = std::clamp((until - from) / count, Time{}, gap);
    std::size_t largest = 1;
    for (const Send& one : datagrams) largest = std::max(largest, one.bytes.size());
    const auto fitting = static_cast<Time::rep>(batch.bytes / largest);
    const Time::rep at_once =
        gap > Time{} ? std::max<Time::rep>(std::min(batch.time / gap, fitting), 1) : count;
    for (Time::rep i = 0; i < count; ++i)
        datagrams[static_cast<std::size_t>(i)].not_before = from + i / at_once * at_once * gap;
    return from + count * gap;
}

}  // namespace echoloop
