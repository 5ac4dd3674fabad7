#include "emulator/clock/clock.h"

namespace echoloop {

double Clock::unix_time() const {
    if (unix_start_) return *unix_start_ + to_seconds(now());
    return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
}

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
    if (!ec) clock_.rang(when);
}

void Alarm::cancel() {
    if (set_) clock_.unset(*this);
    set_ = false;
    timer_.cancel();
}

Time RealClock::now() const {
    const std::chrono::duration<double, std::nano> real(Steady::now() - start_);
    return Time(static_cast<Time::rep>(real.count() * rate_));
}

void RealClock::run() {
    while (io().run_one() > 0) worked_until_ = now();
}

void RealClock::rang(Time when) {
    if (worked_until_ > when) return;
    slept_from_ = worked_until_;
    slept_to_ = now();
}

Time RealClock::overslept(Time due) const {
    return slept_from_ <= due && due < slept_to_ ? slept_to_ - due : Time{};
}

void RealClock::set(Alarm& alarm, Time when) { alarm.timer_.expires_at(instant(when)); }

RealClock::Steady::time_point RealClock::instant(Time t) const {
    const std::chrono::duration<double, std::nano> real(static_cast<double>(t.count()) / rate_);
    return start_ + std::chrono::duration_cast<Steady::duration>(real);
}

}  // namespace echoloop
