#include "emulator/render_thread.h"

#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <future>

#include "render/renderer.h"

namespace echoloop {
namespace {

/// Rendering gives way to the wire: llvmpipe's workers inherit the nice value of the thread that makes the
/// context.
void be_nice() {
    const auto thread = static_cast<id_t>(::syscall(SYS_gettid));
    ::setpriority(PRIO_PROCESS, thread, 10);
}

Echogram silence(Shot shot, const Pose& world_from_sonar) {
    Echogram echogram;
    echogram.world_from_sonar = world_from_sonar;
    echogram.values.assign(shot.bearings.size() * shot.bins, 0.0F);
    echogram.truth.resize(shot.bearings.size());
    echogram.shot = std::move(shot);
    return echogram;
}

}  // namespace

RenderThread::RenderThread(Make make) {
    std::promise<void> started;
    auto ready = started.get_future();
    thread_ = std::jthread([this, make = std::move(make), &started](std::stop_token stop) {
        be_nice();
        std::unique_ptr<Renderer> renderer;
        try {
            renderer = make();
        } catch (...) {
            started.set_exception(std::current_exception());
            return;
        }
        started.set_value();
        serve(stop, *renderer);
    });
    ready.get();
}

RenderThread::~RenderThread() = default;  // the jthread stops and joins

void RenderThread::submit(Shot shot, Situation situation, Done done) {
    {
        const std::lock_guard lock(mutex_);
        jobs_.push_back({std::move(shot), std::move(situation), std::move(done)});
    }
    wake_.notify_one();
}

void RenderThread::serve(std::stop_token stop, Renderer& renderer) {
    while (true) {
        std::unique_lock lock(mutex_);
        if (!wake_.wait(lock, stop, [this] { return !jobs_.empty(); })) return;
        Job job = std::move(jobs_.front());
        jobs_.pop_front();
        lock.unlock();
        if (stop.stop_requested()) return;
        try {
            job.done(renderer.render(job.shot, job.situation), {});
        } catch (const std::exception& error) {
            job.done(silence(std::move(job.shot), job.situation.world_from_sonar), error.what());
        }
    }
}

}  // namespace echoloop
