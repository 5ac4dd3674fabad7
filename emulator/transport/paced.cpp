#include "emulator/transport/paced.h"

#include <algorithm>

namespace echoloop {

Paced::Paced(Clock& clock, std::unique_ptr<Transport> line, double bits_per_second)
    : line_(std::move(line)), clock_(clock), alarm_(clock), byte_time_(10.0 / bits_per_second) {}

Task<void> Paced::write(ByteView bytes, Address to) {
    // Small chunks, each handed over when its last byte would have arrived: a UART's FIFO does about the
    // same.
    const auto chunk = static_cast<std::size_t>(std::clamp(0.001 / byte_time_.count(), 1.0, 64.0));
    free_ = std::max(free_, clock_.now());
    while (!bytes.empty() && !closed_) {
        const ByteView part = bytes.first(std::min(chunk, bytes.size()));
        bytes = bytes.subspan(part.size());
        free_ += std::chrono::duration_cast<Time>(static_cast<double>(part.size()) * byte_time_);
        co_await alarm_.until(free_);
        if (!closed_) co_await line_->write(part, to);
    }
}

void Paced::close() {
    closed_ = true;
    alarm_.cancel();
    line_->close();
}

}  // namespace echoloop
