#include "emulator/water/rendering.h"

#include <spdlog/spdlog.h>

#include <utility>

namespace echoloop {

Task<void> Rendering::ready() {
    const Clock::Hold hold(clock_);
    while (!echogram) co_await done_.until(Time::max());
}

std::shared_ptr<Rendering> Rendering::start(RenderThreads& threads, Clock& clock, RenderThreads::Job job,
                                            const std::string& name) {
    auto rendering = std::make_shared<Rendering>(clock);
    job.done = [&io = clock.io(), rendering, name](Echogram echogram, const std::string& error) mutable {
        if (!error.empty()) spdlog::error("{}: ping not rendered: {}", name, error);
        asio::post(io, [rendering = std::move(rendering), echogram = std::move(echogram)]() mutable {
            rendering->echogram = std::move(echogram);
            rendering->finished = rendering->clock_.now();
            rendering->done_.cancel();
        });
    };
    threads.submit(std::move(job));
    return rendering;
}

}  // namespace echoloop
