#include "emulator/transport/baud_check.h"

#include <spdlog/spdlog.h>

#include <algorithm>

namespace echoloop {

BaudCheck::BaudCheck(Clock& clock, std::unique_ptr<Transport> line, double rate, std::string device)
    : Decorator(std::move(line)), clock_(clock), alarm_(clock), rate_(rate), device_(std::move(device)) {}

void BaudCheck::start(Events events) {
    Events ours = events;
    ours.received = [this, received = std::move(events.received)](ByteView bytes, Address from) {
        const double rate = rate_of_words();
        if (!disagree(rate, rate_)) return received(bytes, from);
        const Bytes garbage = uart::as_heard(bytes, rate, {rate_});
        if (!garbage.empty()) received(garbage, from);
    };
    ours.reconnected = [this, reconnected = std::move(events.reconnected)] {
        changes_ = false;
        seen_ = 0;
        reconnected();
    };
    line().start(std::move(ours));
}

/// A driver that sets another rate once its words are out, to hear the answer at it, may have done so before
/// they were read here: a pseudo-terminal carries no times. So one that asks for other rates is believed to
/// be back at the device's own when it speaks.
double BaudCheck::rate_of_words() {
    const double now = line().far_end().rate, before = std::exchange(seen_, now);
    return changes_ || (before > 0 && uart::agree(before, rate_)) ? rate_ : now;
}

bool BaudCheck::disagree(double driver, double own) {
    if (driver <= 0 || uart::agree(driver, own)) return false;
    if (std::exchange(told_, {driver, own}) == std::pair(driver, own)) return true;
    if (own == rate_)
        spdlog::warn(
            "{}: the driver has set {:.0f} bit/s but the device talks at {:.0f}, so each receives garbage "
            "from the other. Set the driver to {:.0f}, or the device's option baud to {:.0f}, or add "
            "?baud_check=off to the endpoint",
            device_, driver, own, own, driver);
    else
        spdlog::warn(
            "{}: the driver has asked for an answer at {:.0f} bit/s and has set {:.0f}: it receives garbage. "
            "Set it to {:.0f} before the answer comes, and back to {:.0f} after it",
            device_, own, driver, own, rate_);
    return true;
}

void BaudCheck::speak_at(double rate) {
    asked_ = rate;
    changes_ = changes_ || (rate > 0 && !uart::agree(rate, rate_));
    line().speak_at(rate);
}

void BaudCheck::cut_off() {
    ++cuts_;
    free_ = {};
    alarm_.cancel();
    line().cut_off();
}

Task<void> BaudCheck::write(ByteView bytes, Address to) {
    const uart::Receiver driver = line().far_end();
    const double own = asked_ > 0 ? asked_ : rate_;
    seen_ = driver.rate;
    if (!disagree(driver.rate, own)) {
        co_await line().write(bytes, to);
        co_return;
    }
    const Time begin = std::max(free_, clock_.now());
    const Time duration = from_seconds(uart::bits_per_byte * static_cast<double>(bytes.size()) / own);
    free_ = begin + duration;
    co_await write_garbage(uart::as_heard(bytes, own, driver), begin, duration);
}

/// Spread over the time that the good bytes would have taken.
Task<void> BaudCheck::write_garbage(Bytes garbage, Time begin, Time duration) {
    constexpr double often = 1e-3;  // s
    const double each = to_seconds(duration) / static_cast<double>(std::max<std::size_t>(garbage.size(), 1));
    const auto chunk = static_cast<std::size_t>(std::max(1.0, often / each));
    const std::uint64_t cuts = cuts_;
    for (std::size_t done = 0; done < garbage.size() && !closed_ && cuts == cuts_;) {
        const ByteView part = ByteView(garbage).subspan(done, std::min(chunk, garbage.size() - done));
        done += part.size();
        co_await alarm_.until(begin + from_seconds(each * static_cast<double>(done)));
        if (!closed_ && cuts == cuts_) co_await line().write(part, {});
    }
    if (!closed_ && cuts == cuts_) co_await alarm_.until(begin + duration);
}

void BaudCheck::close() {
    closed_ = true;
    alarm_.cancel();
    line().close();
}

}  // namespace echoloop
