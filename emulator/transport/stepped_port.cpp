#include "emulator/transport/stepped_port.h"

#include <spdlog/spdlog.h>

namespace echoloop {
namespace {

constexpr std::size_t most_in_a_step = 16 << 20;  // bytes; who sends more during one step is not listening

}  // namespace

SteppedPort::SteppedPort(SteppedClock& clock, std::unique_ptr<Transport> transport)
    : Decorator(std::move(transport)), clock_(clock) {
    clock_.on_settle([this] { line().settle(); });
}

void SteppedPort::start(Events events) {
    events_ = std::move(events);
    line().start(
        {.received = [this](ByteView bytes, Address from) { received(bytes, from); },
         .reconnected = [this] { in_turn([this] { events_.reconnected(); }); },
         .connected = [this](Address peer) { in_turn([this, peer] { events_.connected(peer); }); },
         .disconnected = [this](Address peer) { in_turn([this, peer] { events_.disconnected(peer); }); },
         .line_rate = [this](double rate) { in_turn([this, rate] { events_.line_rate(rate); }); }});
}

void SteppedPort::in_turn(std::function<void()> event) {
    if (!clock_.stepping()) return event();
    clock_.later(std::move(event));
}

void SteppedPort::received(ByteView bytes, Address from) {
    if (!clock_.stepping()) return events_.received(bytes, from);
    if (waiting_ + bytes.size() > most_in_a_step) {
        spdlog::warn("{}: more than 16 MiB arrived during one step; {} bytes are lost", describe(),
                     bytes.size());
        return;
    }
    waiting_ += bytes.size();
    clock_.later([this, copy = Bytes(bytes.begin(), bytes.end()), from] {
        waiting_ -= copy.size();
        events_.received(copy, from);
    });
}

Task<void> SteppedPort::write(ByteView bytes, Address to) {
    const Clock::Hold hold(clock_);
    co_await line().write(bytes, to);
}

std::unique_ptr<Transport> in_step(Clock& clock, std::unique_ptr<Transport> line) {
    auto* const stepped = dynamic_cast<SteppedClock*>(&clock);
    if (stepped == nullptr) return line;
    return std::make_unique<SteppedPort>(*stepped, std::move(line));
}

}  // namespace echoloop
