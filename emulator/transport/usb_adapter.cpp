#include "emulator/transport/usb_adapter.h"

#include <algorithm>
#include <utility>

namespace echoloop {
namespace {

constexpr std::size_t packet = 62;  // 64 bytes at full speed, two of them status (FTDI AN232B-04)

}  // namespace

UsbAdapter::UsbAdapter(Clock& clock, std::unique_ptr<Transport> line, Time latency)
    : Decorator(std::move(line)), clock_(clock), alarm_(clock), latency_(latency) {}

void UsbAdapter::start(Events events) {
    const auto reconnected = std::move(events.reconnected);
    events.reconnected = [this, reconnected] {
        waiting_.clear();
        reconnected();
    };
    line().start(std::move(events));
    rings_ = clock_.now() + latency_;
    asio::co_spawn(clock_.io(), keep_flushing(), Serving(describe()));
}

Task<void> UsbAdapter::write(ByteView bytes, Address to) {
    while (!bytes.empty() && !closed_) {
        const ByteView part = bytes.first(std::min(packet - waiting_.size(), bytes.size()));
        bytes = bytes.subspan(part.size());
        waiting_.insert(waiting_.end(), part.begin(), part.end());
        if (waiting_.size() < packet) continue;
        rings_ = clock_.now() + latency_;
        const Bytes full = std::exchange(waiting_, {});
        co_await line().write(full, to);
    }
}

/// The timer begins anew with each packet that was sent, full or not.
Task<void> UsbAdapter::keep_flushing() {
    while (!closed_) {
        co_await alarm_.until(rings_);
        if (closed_ || clock_.now() < rings_) continue;
        rings_ = std::max(rings_ + latency_, clock_.now());
        const Bytes rest = std::exchange(waiting_, {});
        if (!rest.empty()) co_await line().write(rest, {});
    }
}

void UsbAdapter::close() {
    closed_ = true;
    alarm_.cancel();
    line().close();
}

}  // namespace echoloop
