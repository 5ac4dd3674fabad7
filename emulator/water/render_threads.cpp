#include "emulator/water/render_threads.h"

#include <pthread.h>

#include <algorithm>
#include <future>
#include <utility>

#include "emulator/machine/scheduling.h"
#include "render/renderer.h"
#include "render/workers.h"

namespace echoloop {
namespace {

/// Rendering gives way to the wires, but hardly to other programs, which would starve it on a busy machine.
/// The name is what top and gdb show.
void begin_thread() {
    ::pthread_setname_np(::pthread_self(), "render");
    give_way(2);
}

Echogram silence(Shot shot, const Pose& world_from_sonar) {
    Echogram echogram;
    echogram.world_from_sonar = world_from_sonar;
    echogram.values.assign(shot.beams() * shot.bins, 0.0F);
    echogram.truth.resize(shot.beams());
    echogram.shot = std::move(shot);
    return echogram;
}

}  // namespace

std::size_t RenderThreads::useful(std::size_t sonars) {
    return std::clamp<std::size_t>(sonars, 1, Workers::useful());
}

std::size_t RenderThreads::drawing_threads(std::size_t sonars) {
    return std::max<std::size_t>(1, Workers::useful() / useful(sonars));
}

RenderThreads::RenderThreads(const Make& make, std::size_t threads) : count_(threads) {
    keep_rasterisers_on_their_threads();
    std::vector<std::future<void>> ready;
    for (std::size_t i = 0; i < threads; ++i) {
        std::promise<void> started;
        ready.push_back(started.get_future());
        threads_.emplace_back(
            [this, make, started = std::move(started)](const std::stop_token& stop) mutable {
                std::unique_ptr<Renderer> renderer;
                try {
                    begin_thread();
                    renderer = make();
                } catch (...) {
                    return started.set_exception(std::current_exception());
                }
                started.set_value();
                serve(*renderer, stop);
            });
    }
    for (auto& renderer : ready) renderer.wait();
    for (auto& renderer : ready) renderer.get();
}

RenderThreads::~RenderThreads() {
    for (std::jthread& thread : threads_) thread.request_stop();
}

void RenderThreads::submit(Job job) {
    {
        const std::lock_guard lock(mutex_);
        jobs_.insert(std::ranges::upper_bound(jobs_, job.needed, {}, &Job::needed), std::move(job));
    }
    changed_.notify_all();
}

RenderThreads::Load RenderThreads::load() const {
    const std::lock_guard lock(mutex_);
    return {count_, busy_.size(), jobs_.size()};
}

/// The first of the jobs that are the first ones of sonars that have none under way.
RenderThreads::Jobs::iterator RenderThreads::most_urgent() {
    std::set<std::size_t> seen = busy_;
    return std::ranges::find_if(
        jobs_, [&](const Job& job) { return seen.insert(job.sonar).second && leaves_a_thread(job.shot); });
}

void RenderThreads::serve(Renderer& renderer, const std::stop_token& stop) {
    std::unique_lock lock(mutex_);
    while (true) {
        auto next = jobs_.end();
        changed_.wait(lock, stop, [&] { return (next = most_urgent()) != jobs_.end(); });
        if (stop.stop_requested()) return;
        Job job = std::move(*next);
        jobs_.erase(next);
        const std::size_t images = job.shot.rows() > 1 ? 1 : 0;
        const std::size_t sonar = job.sonar;
        busy_.insert(sonar);
        images_ += images;
        lock.unlock();
        render(renderer, job);
        lock.lock();
        busy_.erase(sonar);
        images_ -= images;
        changed_.notify_all();
    }
}

void RenderThreads::render(Renderer& renderer, Job& job) {
    try {
        job.done(renderer.render(job.shot, job.situation), {});
    } catch (const std::exception& error) {
        job.done(silence(std::move(job.shot), job.situation.world_from_sonar), error.what());
    }
}

}  // namespace echoloop
