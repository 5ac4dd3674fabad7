#include "emulator/transport/paced.h"

#include <algorithm>
#include <chrono>

namespace echoloop {
namespace {

/// What has arrived by these instants is handed over at once, by all lines together: a UART's FIFO keeps
/// bytes about as long, and a dozen lines wake a processor no more often than one does.
constexpr Time tick = std::chrono::milliseconds(2);

struct Handover {
    std::size_t arrived;  ///< of the message's bytes, all in all
    Time time;
};

struct Message {
    Time begin;
    double byte_time;  ///< s
    std::size_t size;

    Time arrival_of(std::size_t bytes) const {
        return begin + from_seconds(static_cast<double>(bytes) * byte_time);
    }

    /// The next one, when `done` bytes have been handed over. The last byte never waits for a tick, nor do
    /// those of slow lines.
    Handover after(std::size_t done) const {
        const Time next = arrival_of(done + 1);
        if (2 * byte_time > to_seconds(tick)) return {done + 1, next};
        const Time time = (next + tick - Time(1)) / tick * tick;
        const auto arrived = static_cast<std::size_t>(to_seconds(time - begin) / byte_time);
        if (arrived >= size) return {size, arrival_of(size)};
        return {std::max(arrived, done + 1), time};
    }
};

}  // namespace

Paced::Paced(Clock& clock, std::unique_ptr<Transport> line, double rate, OtherRate other)
    : Decorator(std::move(line)), clock_(clock), alarm_(clock), rate_(rate), other_(other) {}

double Paced::rate_now() const {
    const double driver = line().far_end().rate, own = asked_ > 0 ? asked_ : rate_;
    if (driver <= 0) return own;
    if (other_ == OtherRate::followed || uart::agree(driver, own)) return driver;
    return other_ == OtherRate::garbage ? 0 : own;
}

double Paced::line_rate() const {
    constexpr double fastest = 921600;  // that drivers of sonars set; one that sets none is not slower
    const double now = rate_now();
    return now > 0 ? now : rate_ > 0 ? rate_ : fastest;
}

void Paced::start(Events events) {
    const auto reconnected = std::move(events.reconnected);
    events.reconnected = [this, reconnected] {
        ++cuts_;  // the rest was for the one who has left
        alarm_.cancel();
        reconnected();
    };
    line().start(std::move(events));
}

Task<void> Paced::write(ByteView bytes, Address to) {
    const double rate = rate_now();
    if (rate <= 0) {
        co_await line().write(bytes, to);
        co_return;
    }
    const Message message{std::max(free_, clock_.now()), uart::bits_per_byte / rate, bytes.size()};
    free_ = message.arrival_of(bytes.size());
    const std::uint64_t cuts = cuts_;
    for (std::size_t done = 0; done < bytes.size();) {
        const Handover next = message.after(done);
        co_await alarm_.until(next.time);
        if (closed_ || cuts != cuts_) co_return;
        co_await line().write(bytes.subspan(done, next.arrived - done), to);
        done = next.arrived;
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
