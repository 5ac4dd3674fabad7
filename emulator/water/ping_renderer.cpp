#include "emulator/water/ping_renderer.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <utility>

namespace echoloop {
namespace {

/// Longer than other programs or a virtual machine's host keep a processor busy for a moment.
constexpr double longest_ahead = 1.0;  // s
/// Of one sonar's echograms.
constexpr double most_memory = 64e6;  // bytes
constexpr double most_pings = 16;
/// When a driver changes its settings, what is ahead was rendered for nothing: one ping, and of all others
/// no more than a quarter.
constexpr std::size_t pings_for_one_more = 4;

}  // namespace

std::shared_ptr<Rendering> PingRenderer::render(Time needed, Shot shot, Situation situation) {
    auto rendering = std::make_shared<Rendering>(clock_);
    submit({sonar_, needed}, std::move(shot), std::move(situation), rendering);
    return rendering;
}

std::shared_ptr<Rendering> PingRenderer::render(const Ping& ping, const Situation& situation) {
    if (expected_.empty() || !expected_.front().is(ping.shot, situation)) {
        expect_nothing();
        return render(ping.due, ping.shot, situation);
    }
    ++as_expected_;
    auto ahead = std::move(expected_.front().rendering);
    expected_.pop_front();
    return ahead ? std::move(ahead) : render(ping.due, ping.shot, situation);
}

void PingRenderer::expect_next(Ping ping, Time sent, bool objects) {
    if (!situation_at_ || ping.shot.interval <= 0) return expect_nothing();
    Expected next = after(std::move(ping), sent, objects);
    // A ping at another time than planned may be as expected, and those behind it not.
    if (!expected_.empty() && !expected_.front().is(next.ping.shot, next.situation)) withdraw_all();
    if (expected_.empty()) expected_.push_back(std::move(next));
    while (expected_.size() < pings_ahead(expected_.front().ping.shot))
        expected_.push_back(after(expected_.back().ping, expected_.back().sent, objects));
    if (as_expected_ == 0) return;
    if (expected_.front().rendering) threads_.hurry(expected_.front().ticket);
    for (Expected& one : expected_) {
        if (one.rendering) continue;
        one.rendering = std::make_shared<Rendering>(clock_);
        const bool patient = &one != &expected_.front();
        one.ticket = submit({sonar_, one.ping.due, patient}, one.ping.shot, one.situation, one.rendering);
    }
}

void PingRenderer::expect_nothing() {
    withdraw_all();
    as_expected_ = 0;
}

void PingRenderer::withdraw_all() {
    for (const Expected& one : expected_)
        if (one.rendering) threads_.withdraw(one.ticket);
    expected_.clear();
}

PingRenderer::Expected PingRenderer::after(Ping ping, Time sent, bool objects) const {
    const Time step = from_seconds(ping.shot.interval);
    ++ping.shot.ping;
    ping.due += step;
    Situation situation = situation_at_(sent + step);
    situation.objects = objects;
    return {std::move(ping), sent + step, std::move(situation)};
}

std::size_t PingRenderer::pings_ahead(const Shot& shot) const {
    const double in_time = longest_ahead / shot.interval;
    const double in_memory = most_memory / (static_cast<double>(shot.beams() * shot.bins) * sizeof(float));
    const auto most = static_cast<std::size_t>(std::clamp(std::min(in_time, in_memory), 1.0, most_pings));
    return std::min(most, 1 + as_expected_ / pings_for_one_more);
}

RenderThread::Ticket PingRenderer::submit(RenderThread::Claim claim, Shot shot, Situation situation,
                                          const std::shared_ptr<Rendering>& rendering) {
    return threads_.submit(
        claim, std::move(shot), std::move(situation),
        [&inbox = inbox_, rendering, open = open_, name = name_](Echogram echogram,
                                                                 std::string error) mutable {
            inbox.post([rendering = std::move(rendering), open = std::move(open), name = std::move(name),
                        echogram = std::move(echogram), error = std::move(error)]() mutable {
                if (!*open) return;
                if (!error.empty()) spdlog::error("{}: ping not rendered: {}", name, error);
                rendering->echogram = std::move(echogram);
                rendering->done.cancel();
            });
        });
}

}  // namespace echoloop
