#include "emulator/transport/baud_check.h"

#include <spdlog/spdlog.h>

#include <algorithm>

namespace echoloop {

BaudCheck::BaudCheck(Clock& clock, std::unique_ptr<Transport> line, double rate, std::string device)
    : Decorator(std::move(line)), clock_(clock), alarm_(clock), rate_(rate), device_(std::move(device)) {}

void BaudCheck::start(Events events) {
    Events ours = events;
    ours.received = [this, received = std::move(events.received)](ByteView bytes, Address from) {
        const uart::Receiver driver = line().far_end();
        if (!disagrees_with(driver)) return received(bytes, from);
        const Bytes garbage = uart::as_heard(bytes, driver.rate, {rate_});
        if (!garbage.empty()) received(garbage, from);
    };
    line().start(std::move(ours));
}

bool BaudCheck::disagrees_with(const uart::Receiver& driver) {
    if (driver.rate <= 0 || uart::agree(driver.rate, rate_)) return false;
    if (told_ != driver.rate)
        spdlog::warn(
            "{}: the driver has set {:.0f} bit/s and the device talks at {:.0f}: they hear garbage of one "
            "another. Set the driver to {:.0f}, or the device's option baud to {:.0f}, or write "
            "?baud_check=off behind the endpoint",
            device_, driver.rate, rate_, rate_, driver.rate);
    told_ = driver.rate;
    return true;
}

Task<void> BaudCheck::write(ByteView bytes, Address to) {
    const uart::Receiver driver = line().far_end();
    if (!disagrees_with(driver)) {
        co_await line().write(bytes, to);
        co_return;
    }
    const Time begin = std::max(free_, clock_.now());
    const Time duration = from_seconds(uart::bits_per_byte * static_cast<double>(bytes.size()) / rate_);
    free_ = begin + duration;
    co_await write_garbage(uart::as_heard(bytes, rate_, driver), begin, duration);
}

/// Spread over the time that the good bytes would have taken.
Task<void> BaudCheck::write_garbage(Bytes garbage, Time begin, Time duration) {
    constexpr double often = 1e-3;  // s
    const double each = to_seconds(duration) / static_cast<double>(std::max<std::size_t>(garbage.size(), 1));
    const auto chunk = static_cast<std::size_t>(std::max(1.0, often / each));
    for (std::size_t done = 0; done < garbage.size() && !closed_;) {
        const ByteView part = ByteView(garbage).subspan(done, std::min(chunk, garbage.size() - done));
        done += part.size();
        co_await alarm_.until(begin + from_seconds(each * static_cast<double>(done)));
        if (!closed_) co_await line().write(part, {});
    }
    if (!closed_) co_await alarm_.until(begin + duration);
}

void BaudCheck::close() {
    closed_ = true;
    alarm_.cancel();
    line().close();
}

}  // namespace echoloop
