#include "render/gl/drawing_crew.h"

#include <algorithm>
#include <atomic>
#include <chrono>

namespace echoloop::gl {
namespace {

using Clock = std::chrono::steady_clock;

/// Of llvmpipe: what a view costs, in pixels that show something. Only the balance between threads depends on
/// it.
double cost_of(const SeenView& seen) {
    constexpr double pixels_per_triangle = 6;
    return static_cast<double>(seen.view->lines * seen.view->samples) +
           pixels_per_triangle * static_cast<double>(seen.triangles);
}

/// Less than that is drawn before another thread has woken up: half a millisecond.
constexpr double worth_sharing = 60'000;

}  // namespace

DrawingCrew::DrawingCrew(MakeContext make, std::shared_ptr<const Scene> scene, std::size_t threads,
                         std::shared_ptr<Workers> workers)
    : make_(std::move(make)),
      scene_(std::move(scene)),
      own_(make_(), scene_),
      split_(scene_),
      threads_(threads),
      workers_(workers ? std::move(workers) : std::make_shared<Workers>(threads)),
      drawers_(threads) {
    if (!own_.context().draws_beside_others()) threads_ = 1;
}

/// Every drawer dies on its own thread, where its context is current.
DrawingCrew::~DrawingCrew() {
    workers_->visit([this](std::size_t thread) {
        if (thread < drawers_.size()) drawers_[thread].reset();
    });
}

/// The dearest view first. Returns whether they are worth sharing.
bool DrawingCrew::find_order() {
    order_.clear();
    double cost = 0;
    for (const SeenView& seen : seen_) order_.push_back(&seen), cost += cost_of(seen);
    std::ranges::stable_sort(order_, std::greater<>(), [](const SeenView* seen) { return cost_of(*seen); });
    return threads_ > 1 && cost >= worth_sharing;
}

SceneDrawer& DrawingCrew::drawer_of_thread() {
    const std::size_t thread = Workers::number();
    if (thread == 0) return own_;
    auto& drawer = drawers_[thread];
    if (!drawer) drawer = std::make_unique<SceneDrawer>(make_(), scene_);
    return *drawer;
}

void DrawingCrew::draw(const Picture& picture, const Outlook& outlook, std::vector<Pixel>& pixels) {
    const auto since = [](Clock::time_point then) {
        return std::chrono::duration<double>(Clock::now() - then).count();
    };
    const auto begin = Clock::now();
    find_seen(own_.scene(), picture, outlook, seen_);
    if (outlook.rays) split_.split(outlook, seen_);
    const Bending bending{outlook.rays, &split_};
    const std::size_t threads = find_order() ? std::min(threads_, order_.size()) : 1;
    profile_ = {since(begin), 0, 0, 0, 0, 0};
    for (const SeenView& view : seen_) {
        profile_.triangles += view.triangles;
        profile_.chunks += view.chunks;
        profile_.pixels += view.view->lines * view.view->samples;
    }
    const auto seen = Clock::now();
    pixels.resize(picture.image_lines * picture.samples);
    std::atomic<std::size_t> next{0};
    std::atomic<double> read_back{0};
    workers_->run(
        threads,
        [&](std::size_t) {
            SceneDrawer& drawer = drawer_of_thread();
            for (std::size_t i = next++; i < order_.size(); i = next++)
                read_back +=
                    drawer.draw({&order_[i], 1}, picture.samples, outlook.offset, pixels.data(), bending);
        },
        threads);
    profile_.read_back = read_back / static_cast<double>(threads);
    profile_.draw = since(seen) - profile_.read_back;
}

}  // namespace echoloop::gl
