#include "render/gl/drawing_crew.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <future>
#include <mutex>
#include <numeric>
#include <thread>

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

/// A thread and the drawer that belongs to it.
class DrawingCrew::Helper {
  public:
    /// Does not wait until there is a context: the first to draw is the caller.
    Helper(MakeContext make, std::shared_ptr<const Scene> scene) {
        thread_ = std::jthread(
            [this, make = std::move(make), scene = std::move(scene)](const std::stop_token& stop) mutable {
                std::unique_ptr<SceneDrawer> drawer;
                std::exception_ptr fault;
                try {
                    drawer = std::make_unique<SceneDrawer>(make(), std::move(scene));
                } catch (...) {
                    fault = std::current_exception();
                }
                serve(stop, drawer.get(), fault);
            });
    }

    /// The arguments live until end().
    void begin(std::span<const SeenView* const> views, std::size_t samples, SampleOffsets offset,
               Pixel* image, const Bending& bending) {
        {
            const std::lock_guard lock(mutex_);
            work_ = [=](SceneDrawer& drawer) { return drawer.draw(views, samples, offset, image, bending); };
        }
        changed_.notify_one();
    }

    /// What SceneDrawer::draw() returned. Throws what drawing, or making its context, threw.
    double end() {
        std::unique_lock lock(mutex_);
        done_.wait(lock, [this] { return !work_; });
        if (const std::exception_ptr fault = std::exchange(fault_, nullptr)) std::rethrow_exception(fault);
        return read_back_;
    }

  private:
    /// Without a drawer, `without` is the fault of all work.
    void serve(const std::stop_token& stop, SceneDrawer* drawer, const std::exception_ptr& without) {
        std::unique_lock lock(mutex_);
        while (changed_.wait(lock, stop, [this] { return static_cast<bool>(work_); })) {
            const auto work = work_;
            lock.unlock();
            double read_back = 0;
            std::exception_ptr fault = without;
            try {
                if (drawer != nullptr) read_back = work(*drawer);
            } catch (...) {
                fault = std::current_exception();
            }
            lock.lock();
            read_back_ = read_back, fault_ = fault;
            work_ = nullptr;
            done_.notify_one();
        }
    }

    std::mutex mutex_;
    std::condition_variable_any changed_;
    std::condition_variable done_;
    std::function<double(SceneDrawer&)> work_;  ///< under way or waiting, under mutex_
    double read_back_ = 0;
    std::exception_ptr fault_;
    std::jthread thread_;
};

DrawingCrew::DrawingCrew(MakeContext make, std::shared_ptr<const Scene> scene, std::size_t threads)
    : make_(std::move(make)),
      scene_(std::move(scene)),
      own_(make_(), scene_),
      split_(scene_),
      threads_(threads) {
    if (!own_.context().draws_beside_others()) threads_ = 1;
}

DrawingCrew::~DrawingCrew() = default;

/// The dearest view first, each to who has least to do.
void DrawingCrew::share_out() {
    order_.resize(seen_.size());
    std::iota(order_.begin(), order_.end(), 0U);
    std::ranges::stable_sort(order_, std::greater<>(), [&](std::size_t i) { return cost_of(seen_[i]); });
    double cost = 0;
    for (const SeenView& seen : seen_) cost += cost_of(seen);
    const bool alone = cost < worth_sharing;
    while (!alone && helpers_.size() + 1 < threads_)
        helpers_.push_back(std::make_unique<Helper>(make_, scene_));
    shares_.resize(1 + helpers_.size());
    for (Share& share : shares_) share.views.clear(), share.cost = 0;
    const auto sharers = shares_.begin() + (alone ? 1 : std::ssize(shares_));
    for (const std::size_t i : order_) {
        Share& share = *std::ranges::min_element(shares_.begin(), sharers, {}, &Share::cost);
        share.views.push_back(&seen_[i]);
        share.cost += cost_of(seen_[i]);
    }
}

void DrawingCrew::draw(const Picture& picture, const Outlook& outlook, std::vector<Pixel>& pixels) {
    const auto since = [](Clock::time_point then) {
        return std::chrono::duration<double>(Clock::now() - then).count();
    };
    const auto begin = Clock::now();
    find_seen(own_.scene(), picture, outlook, seen_);
    if (outlook.rays) split_.split(outlook, seen_);
    const Bending bending{outlook.rays, &split_};
    share_out();
    profile_ = {since(begin), 0, 0, 0, 0, 0};
    for (const SeenView& view : seen_) {
        profile_.triangles += view.triangles;
        profile_.chunks += view.chunks;
        profile_.pixels += view.view->lines * view.view->samples;
    }
    const auto seen = Clock::now();
    pixels.resize(picture.image_lines * picture.samples);
    for (std::size_t i = 0; i < helpers_.size(); ++i)
        if (!shares_[i + 1].views.empty())
            helpers_[i]->begin(shares_[i + 1].views, picture.samples, outlook.offset, pixels.data(), bending);
    std::exception_ptr fault;
    const auto take = [&](const auto& read_back) {
        try {
            profile_.read_back = std::max(profile_.read_back, read_back());
        } catch (...) {
            fault = std::current_exception();
        }
    };
    take(
        [&] { return own_.draw(shares_[0].views, picture.samples, outlook.offset, pixels.data(), bending); });
    for (std::size_t i = 0; i < helpers_.size(); ++i)
        if (!shares_[i + 1].views.empty()) take([&] { return helpers_[i]->end(); });
    if (fault) std::rethrow_exception(fault);
    profile_.draw = since(seen) - profile_.read_back;
}

}  // namespace echoloop::gl
