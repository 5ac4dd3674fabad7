#include "emulator/pose/step_server.h"

#include <cmath>
#include <nlohmann/json.hpp>

namespace echoloop {
namespace {

using OrderedJson = nlohmann::ordered_json;

Time to_time(double seconds) { return Time(std::llround(seconds * 1e9)); }

std::string in_seconds(double s) { return OrderedJson(s).dump() + " s"; }

/// What a sender of nonsense said goes back to it, whatever its bytes are.
std::string line_of(const OrderedJson& json) {
    return json.dump(-1, ' ', false, OrderedJson::error_handler_t::replace);
}

}  // namespace

StepServer::StepServer(SteppedClock& clock, Sent sent)
    : clock_(clock), sent_(std::move(sent)), bell_(clock) {}

void StepServer::start(std::optional<Time> end, std::function<void()> ended) {
    end_ = end;
    ended_ = std::move(ended);
    asio::co_spawn(clock_.io(), serve(), Serving("clock"));
}

void StepServer::close() {
    closed_ = true;
    bell_.cancel();
}

void StepServer::add(Line line) {
    if (lines_.size() >= most_waiting) return refuse("more than 100000 lines are waiting");
    lines_.push_back(std::move(line));
    bell_.cancel();
}

void StepServer::finish() {
    finished_ = true;
    bell_.cancel();
}

Task<void> StepServer::serve() {
    while (!closed_) {
        if (lines_.empty()) {
            if (finished_) co_return ended_();
            co_await bell_.until(Time::max());
            continue;
        }
        Line line = std::move(lines_.front());
        lines_.pop_front();
        co_await take(std::move(line));
        if (end_ && clock_.now() >= *end_ && last_) co_return ended_();
    }
}

Task<void> StepServer::take(Line line) {
    auto& [text, source, from, connection] = line;
    if (text.reason.empty() && text.now) text.reason = fault_of(*text.now);
    const bool again = text.now && text.reason.empty() && last_ == to_time(*text.now);
    if (again || !text.reason.empty()) text.message.reset();
    source->take(text);
    if (!text.reason.empty()) {
        refuse(text.reason);
        co_return co_await source->answer(error(text.reason), from, connection);
    }
    if (!text.now) co_return;
    if (!again) {
        const Time to = to_time(*text.now);
        co_await clock_.step(end_ ? std::min(to, std::max(*end_, clock_.now())) : to);
        last_ = to;
        ++summary_.steps;
    }
    co_await source->answer(acknowledgement(*text.now), from, connection);
}

std::string StepServer::fault_of(double now) const {
    const double at = to_seconds(clock_.now());
    if (now > at + most_ahead)
        return "now: " + in_seconds(now) + " is more than 4 hours ahead of " + in_seconds(at) +
               ", where the run is; go there in several steps";
    if (to_time(std::max(now, -1.0)) < clock_.now())
        return "now: " + in_seconds(now) + " is before " + in_seconds(at) + ", where the run is";
    return {};
}

void StepServer::refuse(const std::string& reason) {
    ++summary_.refused;
    summary_.last_refusal = reason;
}

std::string StepServer::acknowledgement(double now) const {
    OrderedJson sent = OrderedJson::object();
    for (const auto& [device, bytes] : sent_()) sent[device] = bytes;
    OrderedJson answer{{"now", now}, {"ack", summary_.steps}, {"sent", sent}};
    if (end_ && clock_.now() >= *end_) answer["end"] = true;
    return line_of(answer);
}

std::string StepServer::error(const std::string& reason) const {
    return line_of({{"error", reason}, {"now", to_seconds(clock_.now())}, {"ack", summary_.steps}});
}

StepSummary StepServer::summary() const {
    StepSummary summary = summary_;
    summary.run_time = clock_.now();
    return summary;
}

}  // namespace echoloop
