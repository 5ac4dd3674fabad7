#include <algorithm>
#include <cmath>
#include <future>
#include <numbers>

#include "render/acoustics/chain.h"
#include "render/acoustics/receiver_noise.h"
#include "render/paths/searches.h"
#include "render/recently_used.h"
#include "render/view.h"
#include "render/water.h"

namespace echoloop {

class PathTracer::Impl {
  public:
    Impl(std::shared_ptr<const Scene> scene, std::optional<WaterSurface> surface, Effects effects)
        : scene_(std::move(scene)), surface_(surface), effects_(effects) {
        if (!scene_) throw std::invalid_argument("paths: there is no scene");
        if (surface_ && !effects_.has(Effect::reverberation)) surface_->wind = 0;
    }

    void prepare() {
        if (needed() && !space_ && !prepared_.valid())
            prepared_ = std::async(std::launch::async | std::launch::deferred,
                                   [this] { space_.emplace(scene_, surface_); });
    }

    bool needed() const { return multipath() || !scene_->point_targets().empty(); }

    void trace(const Shot& shot, const Pose& world_from_sonar, double sound_speed, double absorption,
               double end_range, PathEchoes& out, std::span<const Pose> movers, Vec3 turning,
               const RayTable* rays) {
        if (!needed()) return;
        if (prepared_.valid()) prepared_.get();
        if (!space_) space_.emplace(scene_, surface_);
        if (!mirrors_) mirrors_.emplace(scene_);
        place(movers);
        auto& [pattern, cells] =
            patterns_.get([&](const KnownFan& known) { return known.pattern.fits(shot); },
                          [&] { return std::pair(KnownFan(shot, effects_), std::size_t{1}); });
        const double wavenumber = 2 * std::numbers::pi * shot.frequency / sound_speed;
        space_->set_wavenumber(wavenumber);
        space_->set_frequency(shot.frequency);
        std::optional<ImageRays> images;
        if (rays != nullptr) images.emplace(image_tables_, *rays);
        const auto eigenrays = rays != nullptr && !targets_.empty() ? eigenrays_of(*rays) : nullptr;
        const PathPing ping{shot,
                            *space_,
                            pattern,
                            world_from_sonar.position,
                            world_from_sonar.orientation * sonar_from_fan(shot.pan, shot.tilt),
                            absorption,
                            wavenumber,
                            end_range,
                            effects_.has(Effect::spreading),
                            db_to_amplitude(shot.source_level),
                            range_resolution(shot, sound_speed),
                            least_audible(shot),
                            2 / sound_speed * turning,
                            rays,
                            images ? &*images : nullptr,
                            eigenrays.get()};
        find_target_echoes(ping, targets_, multipath(), out.targets);
        if (!multipath()) return;
        const auto faces = faces_ahead(ping, *mirrors_);
        find_glints(ping, *mirrors_, faces, out.targets);
        find_image_echoes(ping, *mirrors_, faces, out.targets, out.diffuse);
        corners_.clear();
        cells.place(shot.ping);
        find_diffuse_echoes(ping, cells, out.diffuse, corners_);
        find_corner_echoes(ping, corners_, out.targets);
    }

  private:
    std::shared_ptr<const Eigenrays> eigenrays_of(const RayTable& rays) {
        return eigenrays_.get(
            [&](const auto& known) { return known->fits(rays); },
            [&] { return std::pair(std::make_shared<const Eigenrays>(rays), std::size_t{1}); });
    }

    struct KnownFan {
        KnownFan(const Shot& shot, const Effects& effects)
            : pattern(shot, effects),
              cells(shot, pattern.half_width(), pattern.half_height(),
                    pattern.across() ? &*pattern.across() : nullptr) {}
        FanPattern pattern;
        LobeCells cells;
    };

    bool multipath() const { return effects_.has(Effect::multipath); }

    /// uPa: 10 dB below the noise; 0 where there is none.
    double least_audible(const Shot& shot) const {
        if (!effects_.has(Effect::noise)) return 0;
        return std::sqrt(0.1 * received_noise(shot));
    }

    void place(std::span<const Pose> movers) {
        if (!std::ranges::equal(movers, placed_)) {
            space_->place(movers);
            mirrors_->place(movers);
            placed_.assign(movers.begin(), movers.end());
        }
        targets_.assign(scene_->point_targets().begin(), scene_->point_targets().end());
        for (PointTarget& target : targets_)
            if (target.mover > 0 && target.mover <= movers.size())
                target.position = movers[target.mover - 1] * target.position;
    }

    std::shared_ptr<const Scene> scene_;
    std::optional<WaterSurface> surface_;
    Effects effects_;
    std::optional<PathSpace> space_;
    std::optional<Mirrors> mirrors_;
    std::vector<Pose> placed_;          ///< the movers
    std::vector<PointTarget> targets_;  ///< where they are at the ping at hand
    RecentlyUsed<KnownFan> patterns_{64};
    ImageTables image_tables_;
    RecentlyUsed<std::shared_ptr<const Eigenrays>> eigenrays_{24};
    std::vector<Corner> corners_;
    std::future<void> prepared_;  ///< last: it is waited for first
};

PathTracer::PathTracer(std::shared_ptr<const Scene> scene, std::optional<WaterSurface> surface,
                       Effects effects)
    : impl_(std::make_unique<Impl>(std::move(scene), surface, effects)) {}
PathTracer::~PathTracer() = default;

void PathTracer::trace(const Shot& shot, const Pose& world_from_sonar, double sound_speed, double absorption,
                       double end_range, PathEchoes& out, std::span<const Pose> movers, Vec3 turning,
                       const RayTable* rays) {
    impl_->trace(shot, world_from_sonar, sound_speed, absorption, end_range, out, movers, turning, rays);
}
void PathTracer::prepare() { impl_->prepare(); }
bool PathTracer::needed() const { return impl_->needed(); }

}  // namespace echoloop
