#include "emulator/replay/timed.h"

#include <algorithm>

namespace echoloop::replay {
namespace {

/// Of a capture that takes no time: what is played over and over lets others have a turn.
constexpr Time shortest_lap = std::chrono::milliseconds(1);

Time scaled(Time time, double speed) { return from_seconds(to_seconds(time) / speed); }

}  // namespace

TimedPlayer::TimedPlayer(std::unique_ptr<Source> source, double speed, bool loop)
    : source_(std::move(source)), speed_(speed), loop_(loop) {}

void TimedPlayer::arrived(Time now) {
    if (start_) return;
    start_ = now;
    load();
}

/// At the end of a lap the next one follows after the gap that the last message had.
void TimedPlayer::load() {
    next_ = source_->next_of_device();
    if (next_) return;
    ++counts_.laps;
    if (!loop_) return;
    source_->rewind();
    next_ = source_->next_of_device();
    const Time first = next_ ? next_->time : Time{};
    *start_ += std::max(scaled(last_ + last_gap_ - first, speed_), shortest_lap);
    last_ = {};
}

std::optional<Time> TimedPlayer::due() const {
    if (!next_) return {};
    return *start_ + scaled(next_->time, speed_);
}

Outgoing TimedPlayer::take() {
    Said said = std::move(*next_);
    last_gap_ = said.time - last_;
    last_ = said.time;
    load();
    return {said.port, std::move(said.bytes)};
}

}  // namespace echoloop::replay
