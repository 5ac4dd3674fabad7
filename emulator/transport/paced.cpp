#include "emulator/transport/paced.h"

#include <algorithm>

namespace echoloop {

Paced::Paced(Clock& clock, std::unique_ptr<Transport> line, double rate, OtherRate other)
    : Decorator(std::move(line)), clock_(clock), alarm_(clock), rate_(rate), other_(other) {}

double Paced::rate_now() const {
    const double driver = line().far_end().rate;
    if (driver <= 0) return rate_;
    if (other_ == OtherRate::followed || uart::agree(driver, rate_)) return driver;
    return other_ == OtherRate::garbage ? 0 : rate_;
}

Task<void> Paced::write(ByteView bytes, Address to) {
    const double rate = rate_now();
    if (rate <= 0) {
        co_await line().write(bytes, to);
        co_return;
    }
    // Small chunks, each handed over when its last byte would have arrived: a UART's FIFO does about the
    // same, and smaller ones would keep a processor busy with a dozen lines.
    const double byte_time = uart::bits_per_byte / rate;
    const auto chunk = static_cast<std::size_t>(std::clamp(0.002 / byte_time, 1.0, 128.0));
    free_ = std::max(free_, clock_.now());
    while (!bytes.empty() && !closed_) {
        const ByteView part = bytes.first(std::min(chunk, bytes.size()));
        bytes = bytes.subspan(part.size());
        free_ += from_seconds(static_cast<double>(part.size()) * byte_time);
        co_await alarm_.until(free_);
        if (!closed_) co_await line().write(part, to);
    }
}

void Paced::close() {
    closed_ = true;
    alarm_.cancel();
    line().close();
}

}  // namespace echoloop
