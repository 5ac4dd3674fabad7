#include "emulator/transport/paced.h"

#include <algorithm>

namespace echoloop {

Paced::Paced(Clock& clock, std::unique_ptr<Transport> line, double rate, OtherRate other)
    : Decorator(std::move(line)), clock_(clock), alarm_(clock), rate_(rate), other_(other) {}

double Paced::rate_now() const {
    const double driver = line().far_end().rate, own = asked_ > 0 ? asked_ : rate_;
    if (driver <= 0) return own;
    if (other_ == OtherRate::followed || uart::agree(driver, own)) return driver;
    return other_ == OtherRate::garbage ? 0 : own;
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
    const std::uint64_t cuts = cuts_;
    while (!bytes.empty() && !closed_ && cuts == cuts_) {
        const ByteView part = bytes.first(std::min(chunk, bytes.size()));
        bytes = bytes.subspan(part.size());
        free_ += from_seconds(static_cast<double>(part.size()) * byte_time);
        co_await alarm_.until(free_);
        if (!closed_ && cuts == cuts_) co_await line().write(part, to);
    }
}

void Paced::speak_at(double rate) {
    asked_ = rate;
    line().speak_at(rate);
}

void Paced::cut_off() {
    ++cuts_;
    free_ = {};
    alarm_.cancel();
    line().cut_off();
}

void Paced::close() {
    closed_ = true;
    alarm_.cancel();
    line().close();
}

}  // namespace echoloop
