#include "emulator/replay/answering.h"

#include <algorithm>

namespace echoloop::replay {
namespace {

constexpr std::size_t most_answers = 10'000;  // answers to a driver that asks without end
constexpr std::size_t most_names = 1'000;     // of requests that are counted apart

}  // namespace

AnsweringPlayer::AnsweringPlayer(Source& source, const std::vector<DriverPort>& ports, double speed)
    : exchanges_(source), speed_(speed) {
    for (const DriverPort& port : ports) readers_.emplace_back(port.family, port.datagrams);
}

void AnsweringPlayer::arrived(Time now) {
    if (arrived_) return;
    arrived_ = true;
    if (exchanges_.begins_unasked())
        begin_unasked(0, now + scaled(exchanges_.said()[exchanges_.unasked().front()].time));
}

void AnsweringPlayer::heard(std::size_t port, ByteView bytes, Time now) {
    readers_[port].add(bytes, [this, port, now](const WholeMessage& message) {
        if (message.command.key.empty()) {
            counts_.noise += message.bytes.size();
        } else {
            answer(port, message, now);
        }
    });
}

/// What the last driver was to hear is not for this one, and a stream that it had begun has ended.
void AnsweringPlayer::reconnected(std::size_t port) {
    readers_[port].clear();
    std::erase_if(waiting_, [&](const auto& w) { return exchanges_.said()[w.second].port == port; });
    const bool begun = unasked_ && !exchanges_.begins_unasked();
    if (begun && exchanges_.said()[exchanges_.unasked()[*unasked_]].port == port) unasked_.reset();
}

void AnsweringPlayer::answer(std::size_t port, const WholeMessage& request, Time now) {
    ++counts_.requests;
    SameRequests* same = exchanges_.nearest(port, request.command);
    if (same == nullptr) {
        const std::string name = request.name.empty() ? "bytes of no known message" : request.name;
        if (counts_.unanswered.size() < most_names || counts_.unanswered.contains(name))
            ++counts_.unanswered[name];
        return;
    }
    ++counts_.answered;
    const Exchange& exchange = exchanges_.all()[same->exchanges[same->next]];
    same->next = (same->next + 1) % same->exchanges.size();
    answer_with(exchange, now);
    move_unasked(exchange, now);
}

void AnsweringPlayer::answer_with(const Exchange& exchange, Time now) {
    for (std::size_t number = exchange.first; number < exchange.end; ++number)
        if (!exchanges_.said()[number].unasked && waiting_.size() < most_answers)
            waiting_.emplace(now + scaled(exchanges_.said()[number].time - exchange.time), number);
}

void AnsweringPlayer::move_unasked(const Exchange& exchange, Time now) {
    if (exchange.stops_unasked) return unasked_.reset();
    if (!exchange.unasked_after || (unasked_ && !exchange.starts_unasked)) return;
    const std::size_t at = *exchange.unasked_after;
    begin_unasked(at, now + scaled(exchanges_.said()[exchanges_.unasked()[at]].time - exchange.time));
}

void AnsweringPlayer::begin_unasked(std::size_t at, Time due) {
    unasked_ = at;
    unasked_time_ = due;
}

std::optional<Time> AnsweringPlayer::due() const {
    std::optional<Time> first;
    if (!waiting_.empty()) first = waiting_.begin()->first;
    if (unasked_ && (!first || unasked_time_ < *first)) first = unasked_time_;
    return first;
}

Outgoing AnsweringPlayer::take() {
    const bool answer = !waiting_.empty() && (!unasked_ || waiting_.begin()->first <= unasked_time_);
    const auto& unasked = exchanges_.unasked();
    const std::size_t number = answer ? waiting_.begin()->second : unasked[*unasked_];
    const Kept& kept = exchanges_.said()[number];
    if (answer) {
        waiting_.erase(waiting_.begin());
    } else {
        const auto [first, last] = exchanges_.run_of(*unasked_);
        const bool again = *unasked_ == last;
        if (again) ++counts_.laps;
        const std::size_t next = again ? first : *unasked_ + 1;
        const Time gap = again ? exchanges_.usual_gap() : exchanges_.said()[unasked[next]].time - kept.time;
        begin_unasked(next, unasked_time_ + scaled(gap));
    }
    return {kept.port, exchanges_.bytes(kept)};
}

}  // namespace echoloop::replay
