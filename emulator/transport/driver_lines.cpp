#include "emulator/transport/driver_lines.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <utility>

#include "emulator/transport/address.h"

namespace echoloop {
namespace {

constexpr std::size_t most_waiting = 16
                                     << 20;  // bytes for one driver; two pings of the largest sonar at least

/// The end of a connection takes some as well.
std::size_t memory_of(const std::shared_ptr<const Bytes>& bytes) { return 100 + (bytes ? bytes->size() : 0); }

}  // namespace

DriverLines::DriverLines(Clock& clock, std::vector<std::unique_ptr<Transport>> lines, Slow slow,
                         std::size_t most_messages)
    : clock_(clock), slow_(slow), most_messages_(most_messages) {
    for (auto& line : lines) lines_.push_back(std::make_unique<Line>(clock, std::move(line)));
}

void DriverLines::put_around(
    const std::function<std::unique_ptr<Transport>(std::unique_ptr<Transport>)>& around) {
    for (auto& line : lines_) line->wire = around(std::move(line->wire));
}

void DriverLines::start(Events events) {
    events_ = std::move(events);
    for (auto& each : lines_) {
        Line& line = *each;
        line.wire->start({.received =
                              [this, &line](ByteView bytes, Address) {
                                  if (line.driver.port != 0) events_.received(bytes, line.driver);
                              },
                          .reconnected = [] {},
                          .connected =
                              [this, &line](Address peer) {
                                  leave(line);
                                  line.driver = peer;
                                  ++line.visit;
                                  events_.connected(peer);
                              },
                          .disconnected = [this, &line](Address) { leave(line); }});
        asio::co_spawn(clock_.io(), keep_writing(line), Serving(describe()));
    }
}

/// What still waits was for the one who leaves.
void DriverLines::leave(Line& line) {
    line.waiting.clear();
    line.memory = 0;
    line.idle.cancel();
    if (line.driver.port != 0) events_.disconnected(std::exchange(line.driver, {}));
}

std::vector<DriverLines::Line*> DriverLines::meant(Address to) {
    std::vector<Line*> found;
    for (auto& line : lines_)
        if (line->driver.port != 0 && (to == Address{} || line->driver == to)) found.push_back(line.get());
    const bool nobody = std::ranges::all_of(lines_, [](const auto& line) { return line->driver.port == 0; });
    if (nobody) found.push_back(lines_.front().get());
    return found;
}

Task<void> DriverLines::write(ByteView bytes, Address to) {
    if (bytes.empty()) co_return;  // nothing is said; a connection may end behind it
    const auto kept = std::make_shared<const Bytes>(bytes.begin(), bytes.end());
    const auto lines = meant(to);
    for (Line* line : lines) post(*line, kept);
    remarks_.clear();
    if (slow_ == Slow::loses) co_return;
    for (Line* line : lines)
        while (line->busy() && !closed_) co_await line->idle.until(Time::max());
}

void DriverLines::hang_up(Address to) {
    for (Line* line : meant(to)) {
        post(*line, nullptr);
        asio::co_spawn(clock_.io(), insist_on_end(*line), Serving(describe()));
    }
}

Task<void> DriverLines::insist_on_end(Line& line) {
    constexpr Time patience = std::chrono::seconds(2);
    const std::uint64_t visit = line.visit;
    Alarm alarm(clock_);
    co_await alarm.until(clock_.now() + patience);
    if (!closed_ && line.driver.port != 0 && line.visit == visit) line.wire->reset();
}

bool DriverLines::is_full(const Line& line, std::size_t more) const {
    return line.busy() && (line.memory + more > most_waiting || line.waiting.size() >= most_messages_);
}

void DriverLines::post(Line& line, std::shared_ptr<const Bytes> bytes) {
    const std::size_t more = memory_of(bytes);
    if (bytes && is_full(line, more)) {
        if (dropped_++ == 0)
            spdlog::warn("{}: the driver at {} does not read; messages for it are lost", describe(),
                         to_text(line.driver));
        lost_ += bytes->size();
        return;
    }
    line.memory += more;
    line.waiting.push_back({std::move(bytes), remarks_});
    line.mail.cancel();
}

Task<void> DriverLines::keep_writing(Line& line) {
    while (!closed_) {
        if (line.waiting.empty()) {
            line.idle.cancel();
            co_await line.mail.until(Time::max());
            continue;
        }
        const Mail mail = std::move(line.waiting.front());
        line.waiting.pop_front();
        line.memory -= memory_of(mail.bytes);
        line.writing = true;
        for (const std::string& remark : mail.remarks) line.wire->annotate(remark);
        if (mail.bytes)
            co_await line.wire->write(*mail.bytes, {});
        else
            line.wire->hang_up({});
        line.writing = false;
    }
}

bool DriverLines::has_driver() const {
    return std::ranges::any_of(lines_, [](const auto& line) { return line->driver.port != 0; });
}

std::vector<std::string> DriverLines::connected() const {
    std::vector<std::string> all;
    for (const auto& line : lines_)
        for (std::string& one : line->wire->connected()) all.push_back(std::move(one));
    return all;
}

void DriverLines::close() {
    closed_ = true;
    for (auto& line : lines_) {
        line->wire->close();
        line->mail.cancel();
        line->idle.cancel();
    }
}

void DriverLines::settle() {
    for (auto& line : lines_) line->wire->settle();
}

std::uint64_t DriverLines::bytes_in() const {
    std::uint64_t sum = 0;
    for (const auto& line : lines_) sum += line->wire->bytes_in();
    return sum;
}

std::uint64_t DriverLines::bytes_out() const {
    std::uint64_t sum = 0;
    for (const auto& line : lines_) sum += line->wire->bytes_out();
    return sum;
}

std::uint64_t DriverLines::bytes_lost() const {
    std::uint64_t sum = lost_;
    for (const auto& line : lines_) sum += line->wire->bytes_lost();
    return sum;
}

}  // namespace echoloop
