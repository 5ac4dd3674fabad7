#include "emulator/clock/stepped_clock.h"

#include <algorithm>

namespace echoloop {

SteppedClock::~SteppedClock() {
    for (auto& [turn, alarm] : alarms_) alarm->set_ = false;
}

void SteppedClock::set(Alarm& alarm, Time when) {
    alarm.timer_.expires_at(asio::steady_timer::time_point::max());
    alarm.set_ = true;
    alarm.when_ = when;
    alarm.turn_ = turns_++;
    alarms_.emplace(Turn(when, alarm.rank_, alarm.turn_), &alarm);
}

void SteppedClock::unset(Alarm& alarm) { alarms_.erase({alarm.when_, alarm.rank_, alarm.turn_}); }

void SteppedClock::ring_first() {
    const auto first = alarms_.begin();
    now_ = std::max(now_, std::get<Time>(first->first));
    first->second->cancel();  // wakes its coroutine and takes it from the list
}

/// Everything that is ready or due, up to and including `last`.
void SteppedClock::serve_until(Time last) {
    while (!io().stopped()) {
        if (io().poll() > 0) continue;
        if (held()) {
            io().run_one();
            continue;
        }
        if (alarms_.empty() || std::get<Time>(alarms_.begin()->first) > last) return;
        ring_first();
    }
}

void SteppedClock::settle() {
    for (const auto& port : settles_) port();
    serve_until(now_);
}

void SteppedClock::make_step() {
    settle();
    for (const auto& begin : begins_) begin(*asked_);
    if (!std::exchange(begun_, true)) settle();  // ports that were opened by the first step
    stepping_ = true;
    serve_until(*asked_);
    now_ = *asked_;
    for (const auto& port : settles_) port();
    stepping_ = false;
    for (; !later_.empty(); later_.pop_front()) later_.front()();
    asked_.reset();
    done_.cancel();
}

void SteppedClock::run() {
    while (!io().stopped()) {
        io().run_one();
        serve_until(now_);
        if (asked_) make_step();
    }
}

Task<void> SteppedClock::step(Time to) {
    asked_ = to;
    while (asked_) co_await done_.until(Time::max());
}

}  // namespace echoloop
