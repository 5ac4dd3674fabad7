#include "emulator/transport/scripted_line.h"

#include <algorithm>
#include <utility>

namespace echoloop {

ScriptedLine::ScriptedLine(Clock& clock, Wire wire, std::vector<DriverLine> lines)
    : clock_(clock), alarm_(clock), wire_(wire), lines_(std::move(lines)) {}

void ScriptedLine::start(Events events) {
    events_ = std::move(events);
    events_.opened();
    if (wire_.kind == Wire::Kind::tcp_server || wire_.kind == Wire::Kind::tcp_client)
        events_.connected(wire_.remote);
    if (!lines_.empty()) asio::co_spawn(clock_.io(), speak(), Serving("driver of the scenario"));
}

Task<void> ScriptedLine::speak() {
    std::vector<std::uint64_t> said(lines_.size());
    while (!closed_) {
        std::size_t next = lines_.size();
        Time when = Time::max();
        for (std::size_t i = 0; i < lines_.size(); ++i) {
            const DriverLine& line = lines_[i];
            const std::uint64_t times = line.every == Time{} ? 1 : line.times;
            if (times != 0 && said[i] >= times) continue;
            const Time at = line.at + static_cast<Time::rep>(said[i]) * line.every;
            if (at < when) std::tie(when, next) = std::pair(at, i);
        }
        if (next == lines_.size()) co_return;
        while (!closed_ && clock_.now() < when) co_await alarm_.until(when);
        if (closed_) co_return;
        const Bytes& message = lines_[next].message(said[next]++);
        count_in(message.size());
        events_.received(message, wire_.remote);
    }
}

Task<void> ScriptedLine::write(ByteView bytes, Address) {
    count_out(bytes.size());
    co_return;
}

void ScriptedLine::close() {
    closed_ = true;
    alarm_.cancel();
}

}  // namespace echoloop
