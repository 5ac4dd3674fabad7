#include "emulator/replay/stepped.h"

namespace echoloop::replay {

SteppedPlayer::SteppedPlayer(std::unique_ptr<Source> source, const std::vector<DriverPort>& ports, bool loop)
    : source_(std::move(source)), loop_(loop) {
    for (const DriverPort& port : ports) readers_.emplace_back(port.family, port.datagrams);
    load();
}

void SteppedPlayer::load() {
    next_ = source_->next_of_device();
    if (next_) return;
    ++counts_.laps;
    if (!loop_) return;
    source_->rewind();
    next_ = source_->next_of_device();
}

void SteppedPlayer::heard(std::size_t port, ByteView bytes, Time now) {
    readers_[port].add(bytes, [this, now](const WholeMessage& message) {
        if (message.command.key.empty()) {
            counts_.noise += message.bytes.size();
            return;
        }
        ++counts_.requests;
        if (next_) ++counts_.answered;
        stepped(now);
    });
}

void SteppedPlayer::stepped(Time now) {
    ++steps_;
    asked_ = now;
}

std::optional<Time> SteppedPlayer::due() const {
    if (steps_ == 0 || !next_) return {};
    return asked_;
}

Outgoing SteppedPlayer::take() {
    Said said = std::move(*next_);
    --steps_;
    load();
    return {said.port, std::move(said.bytes)};
}

}  // namespace echoloop::replay
