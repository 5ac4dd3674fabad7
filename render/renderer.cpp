#include "render/renderer.h"

#include <algorithm>
#include <chrono>
#include <numbers>
#include <stdexcept>
#include <thread>

#include "render/acoustics/rows.h"
#include "render/fan/closing_speeds.h"
#include "render/fan/focus.h"
#include "render/fan/object_finder.h"
#include "render/fan/patches.h"
#include "render/fan/truth.h"
#include "render/grid/summing.h"
#include "render/renderer_array.h"
#include "render/renderer_channels.h"
#include "render/renderer_checks.h"
#include "render/renderer_strengths.h"
#include "render/renderer_surfaces.h"
#include "render/renderer_water.h"
#include "render/workers.h"

namespace echoloop {
namespace {

/// s of wall time that `work` takes.
template <typename Work>
double timed(const Work& work) {
    const auto begin = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

}  // namespace

class Renderer::Impl {
  public:
    Impl(std::shared_ptr<const Scene> scene, Water water, RendererOptions options)
        : options_(std::move(options)),
          water_((check_settings(water), std::move(water)), options_.surface, effects()),
          scene_(std::move(scene)),
          tracer_(scene_, options_.surface, options_.effects),
          surfaces_((prepare_paths(), scene_), options_, workers_),
          strengths_(*scene_),
          object_of_surface_(objects_of_surfaces(*scene_)),
          mover_of_surface_(movers_of_surfaces(*scene_)),
          plans_(options_.plans ? options_.plans : std::make_shared<PlanCache>()),
          patches_(*scene_),
          fan_(make_fan_summing(*workers_)),
          grid_(make_grid_summing(*workers_)),
          chain_(options_.effects, options_.speckle, workers_) {}

    Echogram render(const Shot& shot, const Situation& situation) {
        start(shot, situation);
        std::optional<Workers::Burst> burst;
        if (together(shot)) burst.emplace(*workers_);
        Echogram out{shot, situation.world_from_sonar, options_.rule, water_.speed(), {}, 0, {}, {}};
        points_.clear(), fresh_.clear();
        for (HeardArray& heard : arrays_) hear(heard, situation, out);
        const FreshPower fresh{fresh_, RangeSteps::of(shot.bins).bins};
        if (radiometric())
            profile_.acoustics = timed([&] { apply_to_rows(chain_, std::move(points_), out, fresh); });
        if (situation.objects) find_objects(out);
        return out;
    }

    ChannelImage render_channels(const Shot& shot, const Situation& situation) {
        if (!shot.elevations.empty())
            throw std::invalid_argument("shot: elevations must be none for channels");
        start(shot, situation);
        if (arrays_.size() > 1)
            throw std::invalid_argument("shot: bearings must be those of one array for channels");
        HeardArray& heard = arrays_.front();
        plan(heard, situation);
        draw(heard, situation);
        return channels_of(*heard.plan, heard.pixels);
    }

    const RenderProfile& profile() const { return profile_; }
    const Scene& scene() const { return *scene_; }
    const Water& water() const { return water_.water(); }
    std::string description() const { return surfaces_.description(); }

  private:
    void check_settings(const Water& water) const {
        echoloop::validate(water);
        validate(options_);
    }

    bool radiometric() const { return options_.rule == EchoRule::radiometric; }
    /// The paper's rule has no acoustics.
    Effects effects() const { return radiometric() ? options_.effects : Effects::none(); }

    /// While contexts are made, as both take long.
    void prepare_paths() {
        if (radiometric()) tracer_.prepare();
    }

    /// Whether a ping is worth waking other threads for, and there are processors for them.
    bool together(const Shot& shot) const {
        constexpr std::size_t worth_it = 16'384;  // values: own choice, between heads and fans
        return options_.drawing_threads > 1 && shot.beams() * shot.bins >= worth_it;
    }

    Summing& summing_of(const Shot& shot) { return shot.elevations.empty() ? *fan_ : *grid_; }

    /// Throws as render().
    void start(const Shot& shot, const Situation& situation) {
        if (std::this_thread::get_id() != thread_)
            throw std::logic_error("a Renderer works only on the thread that made it");
        echoloop::validate(shot);
        check(situation, scene(), movers_);
        auto arrays = echoloop::arrays_of(shot, situation.world_from_sonar);
        arrays_.resize(arrays.size());
        for (std::size_t i = 0; i < arrays.size(); ++i) arrays_[i].array = std::move(arrays[i]);
        profile_ = {};
        water_.begin(shot, situation.world_from_sonar.position.z);
    }

    /// Appends the array's beams to `out`, without their acoustics, and its targets to points_. Indirect
    /// echoes are traced while surfaces are found, and what is true is found while bins are summed.
    void hear(HeardArray& heard, const Situation& situation, Echogram& out) {
        const Shot& shot = heard.shot();
        plan(heard, situation);
        find_motion(heard, situation);
        find_strengths(shot);
        water_.scatter(shot, heard.array.world_from_sonar, situation.detail, strengths_, heard.water);
        place_patches(heard);
        beside(
            shot, [&] { profile_.paths += timed([&] { trace_paths(heard); }); },
            [&] { draw(heard, situation); });
        Summing& summing = summing_of(shot);
        const BinningInput input = binning_input(heard);
        profile_.bins += timed([&] {
            std::vector<float> values, fresh;
            std::vector<BeamTruth> truth;
            beside(
                shot, [&] { truth = find_truth(summing, input, shot); },
                [&] { summing.sum(input, values, fresh); });
            append(std::move(values), out.values);
            append(std::move(fresh), fresh_);
            append(std::move(truth), out.truth);
            if (shot.velocities && shot.rows() == 1) append(closing_speeds(summing, input), out.velocities);
        });
        for (PointEcho& point : summing.points(*heard.plan, heard.paths.targets)) {
            point.beam += heard.array.first_beam;
            points_.push_back(point);
        }
    }

    /// Does both, the first on another thread where there is one that has nothing else to do.
    template <typename First, typename Second>
    void beside(const Shot& shot, const First& first, const Second& second) {
        if (!together(shot)) {
            first(), second();
            return;
        }
        Workers::Aside aside(*workers_, first);
        second();
        aside.wait();
    }

    /// Fills in the plan of the picture.
    void plan(HeardArray& heard, const Situation& situation) {
        const Shot& shot = heard.shot();
        FanGeometry geometry = geometry_of(shot, effects());
        geometry.margin = margin_of(shot, effects(), heard.turning(situation).z);
        const PlanDensity density{options_.columns_per_beam,
                                  options_.pixel_density * situation.detail * situation.density};
        heard.plan =
            plans_->plan_for(geometry, density, [&] { return summing_of(shot).plan(geometry, density); });
    }

    /// Fills in the picture.
    void draw(HeardArray& heard, const Situation& situation) {
        const Shot& shot = heard.shot();
        const auto& rays = water_.rays();
        gl::Outlook outlook = water_.outlook(shot, situation.detail < 1);
        outlook.world_from_fan = heard.world_from_fan(), outlook.movers = movers_;
        outlook.offset = heard.offset(options_.jitter);
        const gl::DrawProfile& drawn = surfaces_.find(*heard.plan, outlook, heard.pixels);
        heard.focus.clear();
        if (rays && rays->focuses() && effects().has(Effect::spreading))
            find_focus(*heard.plan, outlook.offset, outlook.world_from_fan, *rays, heard.pixels, heard.focus);
        profile_.cull += drawn.cull, profile_.draw += drawn.draw, profile_.read_back += drawn.read_back;
        profile_.triangles += drawn.triangles, profile_.chunks += drawn.chunks;
        profile_.pixels += drawn.pixels;
    }

    void trace_paths(HeardArray& heard) {
        const Shot& shot = heard.shot();
        heard.paths.diffuse.clear(), heard.paths.targets.clear();
        if (!radiometric() || !tracer_.needed()) return;
        tracer_.trace(shot, heard.array.world_from_sonar, water_.speed(), water_.absorption(shot),
                      water_.end_range(shot), heard.paths, movers_,
                      heard.motion ? heard.motion->turning : Vec3{}, water_.rays().get());
        if (heard.motion && heard.motion->shifts) shift_paths(*heard.motion, heard.paths);
    }

    /// Fills in the motion of what is drawn.
    void find_motion(HeardArray& heard, const Situation& situation) {
        heard.motion.reset();
        if (!radiometric()) return;
        const Motion own{situation.velocity, heard.turning(situation)};
        heard.motion = motion_of(heard.shot(), *heard.plan,
                                 {heard.world_from_fan().orientation, situation.world_from_sonar.position,
                                  own, movers_, situation.mover_motions, mover_of_surface_},
                                 options_.effects, water_.speed());
    }

    void find_strengths(const Shot& shot) {
        const double wavenumber = 2 * std::numbers::pi * shot.frequency / water_.speed();
        strengths_.find(effects().has(Effect::multipath) ? wavenumber : 0);
    }

    void place_patches(HeardArray& heard) {
        heard.patchy = patches_.any() && effects().has(Effect::texture);
        if (heard.patchy) patches_.place(heard.world_from_fan(), movers_, water_.rays());
    }

    /// Which object is in which bin. What is 10 dB below the noise is not there: nobody could hear it.
    void find_objects(Echogram& out) {
        const double bin_length = out.sound_speed / 2 * out.shot.bin_interval;
        const double bins_at_once = std::max(1.0, range_resolution(out.shot, out.sound_speed) / bin_length);
        const double least = 0.1 * out.noise_power / bins_at_once;
        for (HeardArray& heard : arrays_) {
            const Shot& shot = heard.shot();
            place_patches(heard);
            std::vector<std::uint16_t> objects(shot.beams() * shot.bins);
            finder_.find(summing_of(shot), binning_input(heard), object_of_surface_, least, objects);
            append(std::move(objects), out.objects);
        }
    }

    BinningInput binning_input(const HeardArray& heard) const {
        const Shot& shot = heard.shot();
        const double c = water_.speed();
        return {*heard.plan,
                heard.pixels,
                strengths_.of_surfaces(),
                heard.offset(options_.jitter),
                options_.rule,
                c / 2 * shot.first_bin_time,
                c / 2 * shot.bin_interval,
                shot.bins,
                db_to_power(shot.source_level),
                water_.absorption(shot),
                effects().has(Effect::spreading),
                heard.paths.diffuse,
                heard.focus,
                {},
                heard.water ? &*heard.water : nullptr,
                heard.patchy ? &patches_ : nullptr,
                heard.motion ? &*heard.motion : nullptr};
    }

    RendererOptions options_;
    std::thread::id thread_ = std::this_thread::get_id();
    PingWater water_;
    std::shared_ptr<const Scene> scene_;
    PathTracer tracer_;
    std::shared_ptr<Workers> workers_ = std::make_shared<Workers>();
    SurfaceFinder surfaces_;
    SurfaceStrengths strengths_;
    std::vector<std::uint32_t> object_of_surface_, mover_of_surface_;
    std::shared_ptr<PlanCache> plans_;
    Patches patches_;
    std::unique_ptr<Summing> fan_, grid_;
    ObjectFinder finder_;
    AcousticChain chain_;
    std::vector<HeardArray> arrays_;  ///< of the ping at hand
    std::vector<PointEcho> points_;   ///< the same, of all its beams
    std::vector<float> fresh_;        ///< the same, see FreshPower
    std::vector<Pose> movers_;        ///< the same
    RenderProfile profile_;
};

Renderer::Renderer(std::shared_ptr<const Scene> scene, Water water, RendererOptions options) {
    if (!scene) throw std::invalid_argument("renderer: there is no scene");
    impl_ = std::make_unique<Impl>(std::move(scene), std::move(water), std::move(options));
}
Renderer::~Renderer() = default;
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;

Echogram Renderer::render(const Shot& shot, const Situation& situation) {
    return impl_->render(shot, situation);
}
ChannelImage Renderer::render_channels(const Shot& shot, const Situation& situation) {
    return impl_->render_channels(shot, situation);
}
const RenderProfile& Renderer::profile() const { return impl_->profile(); }
const Scene& Renderer::scene() const { return impl_->scene(); }
const Water& Renderer::water() const { return impl_->water(); }
double Renderer::sound_speed() const { return echoloop::sound_speed(impl_->water()); }
std::string Renderer::context_description() const { return impl_->description(); }

}  // namespace echoloop
