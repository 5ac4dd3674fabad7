#include "emulator/faults/pieces.h"

#include <algorithm>
#include <set>

#include "emulator/contract/options.h"
#include "emulator/faults/seconds.h"

namespace echoloop {
namespace {

constexpr std::size_t queue_limit = 64 << 20;  // bytes

/// Memory that a piece takes; what happened to it may be more than its bytes.
std::size_t memory_of(const Piece& piece) {
    constexpr std::size_t each_event = sizeof(FaultEvent) + 100;  // with its details
    return sizeof(Piece) + piece.bytes.size() + piece.events.size() * each_event;
}

Time delay(const AskedFault& asked) { return from_seconds(number(asked.fault.parameters, "delay")); }

/// Bytes `begin` to `end` and what happened there; what happened at the very end belongs to the last part.
Piece part_of(const Piece& piece, std::size_t begin, std::size_t end) {
    Piece part{{piece.bytes.begin() + static_cast<std::ptrdiff_t>(begin),
                piece.bytes.begin() + static_cast<std::ptrdiff_t>(end)},
               piece.to,
               {},
               piece.due,
               false,
               piece.line_rate};
    for (FaultEvent event : piece.events) {
        const bool last = end == piece.bytes.size() && event.offset >= end;
        if (!last && (event.offset < begin || event.offset >= end)) continue;
        event.offset -= begin;
        part.events.push_back(std::move(event));
    }
    return part;
}

bool go_together(const Piece& one, const Piece& other) {
    return one.to == other.to && one.line_rate == other.line_rate;
}

/// Appends `more` and what happened to it.
void append(Piece& piece, Piece more) {
    for (FaultEvent& event : more.events) {
        event.offset += piece.bytes.size();
        piece.events.push_back(std::move(event));
    }
    piece.bytes.insert(piece.bytes.end(), more.bytes.begin(), more.bytes.end());
}

}  // namespace

Pieces::Pieces(DeviceFaults& faults, FaultPlace place, const MessageTraits& traits)
    : faults_(faults), place_(std::move(place)), traits_(traits) {}

void Pieces::passed(std::size_t size) {
    ++messages_;
    position_ += std::exchange(last_size_, size);
}

void Pieces::add(ByteView bytes, Address to, Time now, double line_rate) {
    message_ = messages_++;
    position_ += last_size_;
    last_size_ = bytes.size();
    first_new_ = queue_.size();
    if (held() + bytes.size() > queue_limit) {
        dropped_bytes_ += bytes.size();
        return;
    }
    give_up_waiting(now);
    if (unplugged(now)) return;
    Piece piece{{bytes.begin(), bytes.end()}, to, {}, now, false, line_rate};
    if (lose(piece, now)) return schedule(std::move(piece), now);
    std::uint64_t copy = 0;
    for (Piece& one : copies(std::move(piece), now)) {
        if (copy > 0 && held() > queue_limit) break;
        damage(one, copy++, now);
        merge(std::move(one), now);
    }
}

std::vector<FaultEvent> Pieces::made_of_last() const {
    std::vector<FaultEvent> made;
    const auto gather = [&](const Piece& piece, bool waits) {
        for (FaultEvent event : piece.events) {
            if (event.message != message_) continue;
            if (waits) event.details.clear();  // how many it will have waited for
            made.push_back(std::move(event));
        }
    };
    for (std::size_t i = first_new_; i < queue_.size(); ++i) gather(queue_[i], false);
    for (const auto* all : {&merging_, &overtaken_})
        for (const Waiting& one : *all) gather(one.piece, true);
    return made;
}

void Pieces::merge(Piece piece, Time now) {
    const AskedFault* merger = nullptr;
    faults_.each(FaultKind::merge, place_, now, [&](const AskedFault& asked) { merger = &asked; });
    if (!merging_.empty() && !go_together(merging_.front().piece, piece)) end_merging(now);
    if (merging_.empty()) {
        if (merger == nullptr) return reorder(std::move(piece), now);
        merging_.push_back(
            waiting({{}, piece.to, {}, now, false, piece.line_rate}, *merger, "messages", now));
    }
    Waiting& all = merging_.front();
    append(all.piece, std::move(piece));
    if (++count(all) >= all.wanted) end_merging(now);
}

void Pieces::end_merging(Time now) {
    if (merging_.empty()) return;
    Waiting all = std::move(merging_.front());
    merging_.clear();
    all.piece.events.front().length = all.piece.bytes.size();
    if (count(all) < 2) all.piece.events.erase(all.piece.events.begin());  // nothing came to be merged with
    reorder(std::move(all.piece), now);
}

void Pieces::reorder(Piece piece, Time now) {
    const AskedFault* held = nullptr;
    faults_.each(FaultKind::reordering, place_, now, [&](const AskedFault& asked) {
        if (held == nullptr && happens(asked, asked.dice.of(message_))) held = &asked;
    });
    if (held != nullptr) {
        overtaken_.push_back(waiting(std::move(piece), *held, "by", now));
        return;
    }
    split(std::move(piece), now);
    for (Waiting& one : overtaken_) ++count(one);
    let_overtaken_go(now);
}

void Pieces::let_overtaken_go(Time now) {
    std::deque<Waiting> still;
    std::vector<Piece> go;
    for (Waiting& one : overtaken_) {
        if (count(one) < one.wanted && one.until > now) {
            still.push_back(std::move(one));
            continue;
        }
        if (count(one) == 0) one.piece.events.erase(one.piece.events.begin() + one.event);
        go.push_back(std::move(one.piece));
    }
    overtaken_ = std::move(still);
    for (Piece& piece : go) split(std::move(piece), now);
}

Pieces::Waiting Pieces::waiting(Piece piece, const AskedFault& asked, const char* counts, Time now) const {
    FaultEvent made = event(asked);
    made.length = piece.bytes.size();
    made.details = {{counts, std::int64_t{0}}};
    const auto at = static_cast<std::ptrdiff_t>(piece.events.size());
    piece.events.push_back(std::move(made));
    return {std::move(piece), now + from_seconds(number(asked.fault.parameters, "within")),
            integer(asked.fault.parameters, counts), at};
}

std::int64_t& Pieces::count(Waiting& waiting) {
    FaultEvent& event = waiting.piece.events[static_cast<std::size_t>(waiting.event)];
    return std::get<std::int64_t>(event.details.front().second);
}

void Pieces::split(Piece piece, Time now) {
    const AskedFault* splitter = nullptr;
    faults_.each(FaultKind::split, place_, now, [&](const AskedFault& asked) {
        if (happens(asked, asked.dice.of(message_))) splitter = &asked;
    });
    if (splitter == nullptr || piece.bytes.size() < 2) return schedule(std::move(piece), now);
    const Dice dice = splitter->dice.of(message_);
    std::set<std::size_t> cuts;
    for (std::size_t i = 1; i < whole(*splitter, "parts"); ++i)
        cuts.insert(1 + dice.below(piece.bytes.size() - 1, i));
    const Time gap = from_seconds(number(splitter->fault.parameters, "gap"));
    std::size_t begin = 0;
    piece.due = now;
    cuts.insert(piece.bytes.size());
    for (const std::size_t end : cuts) {
        Piece part = part_of(piece, begin, end);
        if (begin > 0) {
            part.events.push_back(event(*splitter));
            part.events.back().length = part.bytes.size();
        }
        schedule(std::move(part), now);
        piece.due += gap;
        begin = end;
    }
}

void Pieces::schedule(Piece piece, Time now) {
    piece.due = std::max(piece.due, now);
    const Time ready = piece.due;
    const auto late_by = [&](const AskedFault& asked, Time delay) {
        piece.due += delay;
        piece.events.push_back(event(asked));
        piece.events.back().length = piece.bytes.size();
        piece.events.back().details = {{"delay", told_seconds(delay)}};
    };
    if (!piece.bytes.empty()) {
        faults_.each(FaultKind::latency, place_, now,
                     [&](const AskedFault& asked) { late_by(asked, delay(asked)); });
        faults_.each(FaultKind::jitter, place_, now, [&](const AskedFault& asked) {
            const double part = asked.dice.of(message_).uniform(scheduled_);
            late_by(asked, from_seconds(part * number(asked.fault.parameters, "delay")));
        });
        faults_.each(FaultKind::stale_burst, place_, now, [&](const AskedFault& asked) {
            late_by(asked, std::max(Time{}, *asked.fault.on_until(now) - piece.due));
        });
    }
    ++scheduled_;
    narrow(std::move(piece), ready, now);
}

/// A stream leaves a narrow line bit by bit, as parts of 10 ms; a datagram when its last bit has left.
void Pieces::narrow(Piece piece, Time ready, Time now) {
    const AskedFault* line = nullptr;
    faults_.each(FaultKind::bandwidth, place_, now, [&](const AskedFault& asked) { line = &asked; });
    if (line == nullptr || piece.bytes.empty()) return queue(std::move(piece));
    const double bytes_per_second = number(line->fault.parameters, "bits_per_second") / 8;
    const auto part = static_cast<std::size_t>(std::max(bytes_per_second * 0.01, 1.0));
    const std::size_t size = piece.bytes.size();
    piece.events.push_back(event(*line));
    FaultEvent& made = piece.events.back();
    made.length = size;
    const Time whole_time = from_seconds(static_cast<double>(size) / bytes_per_second);
    const Time begin = std::max(piece.due, line_free_);
    made.details = {{"delay", told_seconds(begin + whole_time - ready)}};
    line_free_ = begin + whole_time;
    for (std::size_t at = 0; at < size;) {
        const std::size_t end = traits_.stream ? std::min(size, at + part) : size;
        Piece one = part_of(piece, at, end);
        one.due = begin + from_seconds(static_cast<double>(end) / bytes_per_second);
        queue(std::move(one));
        at = end;
    }
}

void Pieces::queue(Piece piece) {
    last_due_ = piece.due = std::max(piece.due, last_due_);
    queued_memory_ += memory_of(piece);
    queue_.push_back(std::move(piece));
}

std::size_t Pieces::held() const {
    std::size_t sum = queued_memory_;
    for (const Waiting& one : merging_) sum += memory_of(one.piece);
    for (const Waiting& one : overtaken_) sum += memory_of(one.piece);
    return sum;
}

void Pieces::give_up_waiting(Time now) {
    if (!merging_.empty() && merging_.front().until <= now) end_merging(now);
    let_overtaken_go(now);
}

std::optional<Time> Pieces::next_due() const {
    std::optional<Time> next;
    const auto sooner = [&next](Time time) { next = next ? std::min(*next, time) : time; };
    if (!queue_.empty()) sooner(queue_.front().due);
    for (const Waiting& one : merging_) sooner(one.until);
    for (const Waiting& one : overtaken_) sooner(one.until);
    return next;
}

std::optional<Piece> Pieces::take(Time now) {
    give_up_waiting(now);
    if (queue_.empty() || queue_.front().due > now) return {};
    Piece piece = std::move(queue_.front());
    queue_.pop_front();
    queued_memory_ -= memory_of(piece);
    return piece;
}

void Pieces::hang_up(Time now) {
    for (Waiting& one : merging_) one.until = now;
    for (Waiting& one : overtaken_) one.until = now;
    give_up_waiting(now);
    Piece end;
    end.due = now;
    end.hang_up = true;
    queue(std::move(end));
}

void Pieces::hurry(Time now) {
    for (Waiting& one : merging_) one.until = now;
    for (Waiting& one : overtaken_) one.until = now;
    for (Piece& piece : queue_) piece.due = std::min(piece.due, now);
    last_due_ = line_free_ = now;
}

void Pieces::clear() {
    merging_.clear();
    overtaken_.clear();
    queue_.clear();
    queued_memory_ = 0;
    last_due_ = line_free_ = {};
}

}  // namespace echoloop
