#include "emulator/faults/schedule.h"

#include <algorithm>

namespace echoloop {
namespace {

constexpr Time before_all{-1};

bool needs_telling(const Fault& fault) { return row_of(fault.kind).where != FaultRow::Where::bytes; }

}  // namespace

FaultSchedule::FaultSchedule(Clock& clock, DeviceFaults& faults, Change change)
    : clock_(clock), faults_(faults), change_(std::move(change)), bell_(clock) {
    faults_.on_change([this] { bell_.cancel(); });
}

void FaultSchedule::start() { asio::co_spawn(clock_.io(), keep_going(), Serving(faults_.name())); }

void FaultSchedule::close() {
    closed_ = true;
    bell_.cancel();
}

Task<void> FaultSchedule::keep_going() {
    while (!closed_) {
        const Time now = clock_.now();
        tell(now);
        co_await bell_.until(next(now));
    }
}

void FaultSchedule::tell(Time now) {
    tell_of_cleared();
    for (const AskedFault& asked : faults_.asked()) {
        if (!needs_telling(asked.fault)) continue;
        if (row_of(asked.fault.kind).momentary) {
            tell_of_moments(asked, now);
            continue;
        }
        const bool is_on = asked.fault.on_until(now).has_value(), was_on = on_.contains(asked.id);
        if (is_on == was_on) continue;
        if (is_on) {
            on_.emplace(asked.id, asked.fault);
        } else {
            on_.erase(asked.id);
        }
        change_(asked.fault, asked.id, is_on);
    }
}

/// However many were missed, it happens once.
void FaultSchedule::tell_of_moments(const AskedFault& asked, Time now) {
    Time& told = told_up_.try_emplace(asked.id, before_all).first->second;
    const auto due = asked.fault.next_change(told);
    if (!due || *due > now) return;
    told = now;
    change_(asked.fault, asked.id, true);
}

void FaultSchedule::tell_of_cleared() {
    const auto& asked = faults_.asked();
    const auto is_asked = [&asked](int id) {
        return std::ranges::find(asked, id, &AskedFault::id) != asked.end();
    };
    std::erase_if(told_up_, [&is_asked](const auto& told) { return !is_asked(told.first); });
    for (auto it = on_.begin(); it != on_.end();) {
        if (is_asked(it->first)) {
            ++it;
            continue;
        }
        const auto [id, fault] = *it;
        it = on_.erase(it);
        change_(fault, id, false);
    }
}

Time FaultSchedule::next(Time now) const {
    Time next = Time::max();
    for (const AskedFault& asked : faults_.asked())
        if (needs_telling(asked.fault))
            if (const auto change = asked.fault.next_change(now)) next = std::min(next, *change);
    return next;
}

}  // namespace echoloop
