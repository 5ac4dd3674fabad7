#include "emulator/clock/clock.h"

#include "emulator/machine/standstills.h"

namespace echoloop {

double Clock::unix_time() const {
    if (unix_start_) return *unix_start_ + to_seconds(now());
    return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
}

Inbox& Clock::inbox() { return inbox_ ? *inbox_ : inbox_.emplace(io_); }

Task<void> Alarm::until(Time when) {
    constexpr auto never = asio::steady_timer::time_point::max();
    if (set_) clock_.unset(*this);  // of a coroutine that waits already; the timer's new time wakes it
    set_ = false;
    if (when == Time::max()) {
        timer_.expires_at(never);
    } else {
        clock_.set(*this, when);
    }
    error_code ec;
    co_await timer_.async_wait(into(ec));
    if (!ec) clock_.rang(*this, when);
}

void Alarm::cancel() {
    if (set_) clock_.unset(*this);
    set_ = false;
    timer_.cancel();
}

Time RealClock::now() const { return run_time(Steady::now() - start_); }

RealClock::~RealClock() {
    for (const auto& [when, alarm] : alarms_) alarm->set_ = false;
}

void RealClock::run() {
    if (standstills_ == nullptr) return serve();
    wire_thread_.emplace(io());
    tell_what_is_due();
    const Standstills::Care care(*standstills_, *wire_thread_);
    serve();
}

void RealClock::serve() {
    while (io().run_one() > 0) worked_until_ = now();
}

void RealClock::rang(Alarm& alarm, Time when) {
    if (alarm.set_ && alarm.when_ == when) {
        unset(alarm);
        alarm.set_ = false;
    }
    if (worked_until_ > when) return;
    slept_from_ = worked_until_;
    slept_to_ = now();
}

Time RealClock::overslept(Time due) const {
    return slept_from_ <= due && due < slept_to_ ? slept_to_ - due : Time{};
}

Time RealClock::stood_still(Time since) const {
    if (standstills_ == nullptr) return {};
    return run_time(standstills_->within(instant(since), Steady::now()));
}

Time RealClock::all_stood_still(Time since) const {
    if (standstills_ == nullptr) return {};
    return run_time(standstills_->of_all_within(instant(since), Steady::now()));
}

void RealClock::set(Alarm& alarm, Time when) {
    alarm.timer_.expires_at(instant(when));
    alarm.set_ = true;
    alarm.when_ = when;
    alarms_.emplace(when, &alarm);
    tell_what_is_due();
}

void RealClock::unset(Alarm& alarm) {
    alarms_.erase({alarm.when_, &alarm});
    tell_what_is_due();
}

void RealClock::tell_what_is_due() {
    if (!wire_thread_) return;
    wire_thread_->due(alarms_.empty() ? Steady::time_point::max() : instant(alarms_.begin()->first));
}

Time RealClock::run_time(Steady::duration real) const {
    return Time(static_cast<Time::rep>(std::chrono::duration<double, std::nano>(real).count() * rate_));
}

RealClock::Steady::time_point RealClock::instant(Time t) const {
    const std::chrono::duration<double, std::nano> real(static_cast<double>(t.count()) / rate_);
    return start_ + std::chrono::duration_cast<Steady::duration>(real);
}

}  // namespace echoloop
