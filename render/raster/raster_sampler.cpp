#include "render/raster/raster_sampler.h"

#include <algorithm>
#include <chrono>
#include <numeric>

namespace echoloop::raster {
namespace {

/// What a view costs, in triangles.
std::size_t cost_of(const gl::SeenView& seen) {
    constexpr std::size_t pixels_for_triangle = 1;
    return seen.triangles + seen.view->lines * seen.view->samples / pixels_for_triangle;
}

/// Less than that is drawn before another thread has woken up.
constexpr std::size_t worth_sharing = 20'000;

}  // namespace

RasterSampler::RasterSampler(std::shared_ptr<const Scene> scene, std::size_t threads,
                             std::shared_ptr<Workers> workers)
    : scene_(std::move(scene)),
      split_(scene_),
      threads_(threads),
      workers_(workers ? std::move(workers) : std::make_shared<Workers>(threads)) {}

std::string RasterSampler::description() { return "own rasteriser"; }

std::unique_ptr<ViewPainter> RasterSampler::take_painter() {
    const std::lock_guard lock(mutex_);
    if (idle_.empty()) return std::make_unique<ViewPainter>();
    auto painter = std::move(idle_.back());
    idle_.pop_back();
    return painter;
}

void RasterSampler::give_back(std::unique_ptr<ViewPainter> painter) {
    const std::lock_guard lock(mutex_);
    idle_.push_back(std::move(painter));
}

void RasterSampler::sample(const Picture& picture, const gl::Outlook& outlook, std::vector<Pixel>& pixels) {
    using Clock = std::chrono::steady_clock;
    const auto seconds = [](Clock::duration time) { return std::chrono::duration<double>(time).count(); };
    const auto begin = Clock::now();
    gl::find_seen(*scene_, picture, outlook, seen_);
    if (outlook.rays) split_.split(outlook, seen_);
    profile_ = {};
    std::size_t cost = 0;
    order_.clear();
    for (const gl::SeenView& seen : seen_) {
        profile_.triangles += seen.triangles, profile_.chunks += seen.chunks;
        profile_.pixels += seen.view->lines * seen.view->samples;
        cost += cost_of(seen);
        order_.push_back(&seen);
    }
    std::ranges::stable_sort(order_, std::greater<>(),
                             [](const gl::SeenView* seen) { return cost_of(*seen); });
    const auto culled = Clock::now();
    pixels.resize(picture.image_lines * picture.samples);
    const Painting painting{*scene_, outlook.offset,  outlook.rays.get(),
                            &split_, picture.samples, pixels.data()};
    const auto paint = [&](std::size_t i) {
        auto painter = take_painter();
        painter->paint(painting, *order_[i]);
        give_back(std::move(painter));
    };
    workers_->run(order_.size(), paint, cost < worth_sharing ? 1 : threads_);
    profile_.cull = seconds(culled - begin), profile_.draw = seconds(Clock::now() - culled);
}

}  // namespace echoloop::raster
