#include "emulator/ping_renderer.h"

#include <spdlog/spdlog.h>

#include <utility>

namespace echoloop {

std::shared_ptr<Rendering> PingRenderer::render(Time needed, Shot shot, Situation situation) {
    auto rendering = std::make_shared<Rendering>(clock_);
    submit(needed, std::move(shot), std::move(situation), rendering);
    return rendering;
}

std::shared_ptr<Rendering> PingRenderer::render(const Ping& ping, const Situation& situation) {
    const bool as_expected = expected_ && expected_->shot == ping.shot && expected_->situation == situation;
    auto ahead = as_expected ? std::move(expected_->rendering) : nullptr;
    if (!as_expected) expect_nothing();
    expected_.reset();
    as_expected_ = as_expected;
    return ahead ? std::move(ahead) : render(ping.due, ping.shot, situation);
}

void PingRenderer::expect_next(Ping ping, Time sent, bool objects) {
    if (!situation_at_ || ping.shot.interval <= 0) return;
    const Time step = from_seconds(ping.shot.interval);
    ++ping.shot.ping;
    expected_ = Expected{std::move(ping.shot), situation_at_(sent + step)};
    expected_->situation.objects = objects;
    if (!as_expected_) return;
    expected_->rendering = std::make_shared<Rendering>(clock_);
    expected_->ticket = submit(ping.due + step, expected_->shot, expected_->situation, expected_->rendering);
}

void PingRenderer::expect_nothing() {
    if (expected_ && expected_->rendering) threads_.withdraw(expected_->ticket);
    expected_.reset();
    as_expected_ = false;
}

RenderThread::Ticket PingRenderer::submit(Time needed, Shot shot, Situation situation,
                                          const std::shared_ptr<Rendering>& rendering) {
    return threads_.submit(
        {sonar_, needed}, std::move(shot), std::move(situation),
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
