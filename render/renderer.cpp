#include "render/renderer.h"

#include <chrono>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <thread>

#include "render/acoustics/rows.h"
#include "render/fan/object_finder.h"
#include "render/fan/plan_cache.h"
#include "render/fan/truth.h"
#include "render/gl/drawing_crew.h"
#include "render/grid/summing.h"
#include "render/workers.h"

namespace echoloop {
namespace {

void validate(const RendererOptions& options) {
    if (!(options.columns_per_beam >= 1 && options.columns_per_beam <= 64))
        throw std::invalid_argument("renderer: columns_per_beam must be within 1..64");
    if (!(options.pixel_density >= 0.1 && options.pixel_density <= 64))
        throw std::invalid_argument("renderer: pixel_density must be within 0.1..64");
    if (!(options.drawing_threads >= 1 && options.drawing_threads <= 64))
        throw std::invalid_argument("renderer: drawing_threads must be within 1..64");
}

void validate(const Pose& pose) {
    const Vec3 p = pose.position;
    const Quat q = pose.orientation;
    const double length = std::sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
    if (!(norm(p) < 1e7)) throw std::invalid_argument("pose: position must be finite and within 1e7 m");
    if (!(std::abs(length - 1) < 1e-3))
        throw std::invalid_argument("pose: orientation must be a unit quaternion");
}

/// s of wall time that `work` takes.
template <typename Work>
double timed(const Work& work) {
    const auto begin = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

Pose world_from_fan(const Shot& shot, const Pose& world_from_sonar) {
    return world_from_sonar * Pose{{}, sonar_from_fan(shot.pan, shot.tilt)};
}

}  // namespace

class Renderer::Impl {
  public:
    Impl(std::shared_ptr<const Scene> scene, Water water, RendererOptions options)
        : water_(water),
          options_(std::move(options)),
          tracer_(scene, options_.surface, options_.effects),
          crew_((check_settings(), prepare_paths(), [this] { return gl::make_context(options_.context); }),
                scene, options_.drawing_threads),
          plans_(options_.plans ? options_.plans : std::make_shared<PlanCache>()),
          fan_(make_fan_summing(workers_)),
          grid_(make_grid_summing(workers_)),
          chain_(options_.effects, options_.speckle) {
        for (const std::uint32_t material : drawer().material_of_surface())
            strength_.emplace_back(drawer().scene().materials()[material]);
    }

    Echogram render(const Shot& shot, const Situation& situation) {
        const Pose& pose = situation.world_from_sonar;
        const FanPlan& plan = draw(shot, situation);
        Summing& summing = summing_of(shot);
        Echogram out{shot, pose, options_.rule, echoloop::sound_speed(water_), {}, 0, {}, {}};
        profile_.paths = timed([&] { trace_paths(shot, pose, out.sound_speed); });
        const BinningInput input = binning_input(shot, plan, out.sound_speed);
        profile_.bins = timed([&] {
            summing.sum(input, out.values);
            out.truth = find_truth(summing, input, shot);
        });
        if (options_.rule == EchoRule::radiometric)
            profile_.acoustics =
                timed([&] { apply_to_rows(chain_, summing.points(plan, paths_.targets), out); });
        if (situation.objects) find_objects(summing, input, out);
        return out;
    }

    ChannelImage render_channels(const Shot& shot, const Situation& situation) {
        if (!shot.elevations.empty())
            throw std::invalid_argument("shot: elevations must be none for channels");
        const FanPlan& plan = draw(shot, situation);
        ChannelImage image{plan.lines, plan.samples, {}, {}, {}};
        for (std::size_t sample = 0; sample < plan.samples; ++sample)
            for (std::size_t line = 0; line < plan.lines; ++line) add_channels(image, plan, line, sample);
        return image;
    }

    const RenderProfile& profile() const { return profile_; }
    const Scene& scene() const { return drawer().scene(); }
    const Water& water() const { return water_; }
    std::string description() const { return drawer().description(); }

  private:
    const gl::SceneDrawer& drawer() const { return crew_.drawer(); }

    void check_settings() const {
        echoloop::validate(water_);
        validate(options_);
    }

    /// While contexts are made, as both take long.
    void prepare_paths() {
        if (options_.rule == EchoRule::radiometric) tracer_.prepare();
    }

    Summing& summing_of(const Shot& shot) { return shot.elevations.empty() ? *fan_ : *grid_; }

    void trace_paths(const Shot& shot, const Pose& pose, double c) {
        paths_.diffuse.clear(), paths_.targets.clear();
        if (options_.rule == EchoRule::radiometric && tracer_.needed())
            tracer_.trace(shot, pose, c, absorption(shot), end_range(shot), paths_, movers_);
    }

    /// Np/m.
    double absorption(const Shot& shot) const {
        return effects().has(Effect::absorption)
                   ? db_to_neper(absorption_db_per_km(water_, shot.frequency) / 1e3)
                   : 0;
    }
    /// m, of the window.
    double end_range(const Shot& shot) const {
        return echoloop::sound_speed(water_) / 2 *
               (shot.first_bin_time + static_cast<double>(shot.bins) * shot.bin_interval);
    }

    /// m; of nothing nearer a pulse still sounds in the window.
    double begin_range(const Shot& shot) const {
        return echoloop::sound_speed(water_) / 2 * (shot.first_bin_time - shot.pulse_length);
    }

    /// Which object is in which bin. What is 10 dB below the noise is not there: nobody could hear it.
    void find_objects(Summing& summing, const BinningInput& input, Echogram& out) {
        const double bin_length = out.sound_speed / 2 * out.shot.bin_interval;
        const double bins_at_once = std::max(1.0, range_resolution(out.shot, out.sound_speed) / bin_length);
        out.objects.assign(out.values.size(), 0);
        finder_.find(summing, input, drawer().object_of_surface(), 0.1 * out.noise_power / bins_at_once,
                     out.objects);
    }

    BinningInput binning_input(const Shot& shot, const FanPlan& plan, double c) const {
        return {plan,
                pixels_,
                strength_,
                offset_of(shot),
                options_.rule,
                c / 2 * shot.first_bin_time,
                c / 2 * shot.bin_interval,
                shot.bins,
                db_to_power(shot.source_level),
                absorption(shot),
                effects().has(Effect::spreading),
                paths_.diffuse};
    }

    /// The paper's rule has no acoustics.
    Effects effects() const {
        return options_.rule == EchoRule::radiometric ? options_.effects : Effects::none();
    }

    PixelOffset offset_of(const Shot& shot) const {
        return options_.jitter ? jitter_of(shot.ping) : PixelOffset{};
    }

    /// Fills movers_.
    void place_movers(const Situation& situation) {
        const auto movers = scene().movers();
        if (situation.movers.size() > movers.size())
            throw std::invalid_argument("movers: there are poses for more than the scene has");
        movers_.clear();
        for (std::size_t i = 0; i < movers.size(); ++i)
            movers_.push_back(i < situation.movers.size() ? situation.movers[i] : movers[i].rest);
        for (const Pose& pose : movers_) validate(pose);
    }

    /// Throws as render().
    void check(const Shot& shot, const Situation& situation) {
        if (std::this_thread::get_id() != thread_)
            throw std::logic_error("a Renderer works only on the thread that made it");
        echoloop::validate(shot);
        const Pose& pose = situation.world_from_sonar;
        validate(pose);
        if (!(situation.detail >= 0.1 && situation.detail <= 1))
            throw std::invalid_argument("situation: detail must be within 0.1..1");
        if (!(situation.density >= 0.1 && situation.density <= 1))
            throw std::invalid_argument("situation: density must be within 0.1..1");
        place_movers(situation);
    }

    /// Fills pixels_ and returns the plan that they follow.
    const FanPlan& draw(const Shot& shot, const Situation& situation) {
        check(shot, situation);
        const FanGeometry geometry = geometry_of(shot, effects());
        const PlanDensity density{options_.columns_per_beam,
                                  options_.pixel_density * situation.detail * situation.density};
        plan_ = plans_->plan_for(geometry, density, [&] { return summing_of(shot).plan(geometry, density); });
        const bool background = situation.detail < 1;
        crew_.draw(*plan_,
                   {.world_from_fan = world_from_fan(shot, situation.world_from_sonar),
                    .movers = movers_,
                    .end_range = end_range(shot),
                    .begin_range = background ? begin_range(shot) : 0,
                    .offset = offset_of(shot)},
                   pixels_);
        const gl::DrawProfile& drawn = crew_.profile();
        profile_ = {drawn.cull, drawn.draw,      drawn.read_back, 0,           0,
                    0,          drawn.triangles, drawn.chunks,    drawn.pixels};
        return *plan_;
    }

    void add_channels(ChannelImage& image, const FanPlan& plan, std::size_t line, std::size_t sample) const {
        const std::size_t at = line * plan.samples + sample;
        const View& view = plan.view_of(line);
        const SampleRange nominal = plan.nominal[line];
        const bool seen = pixels_[at].surface != 0 && sample >= nominal.first && sample < nominal.last;
        image.intensity.push_back(seen ? pixels_[at].cosine : 0);
        image.range.push_back(seen ? pixels_[at].range : std::numeric_limits<float>::quiet_NaN());
        image.bearing.push_back(
            static_cast<float>(view.bearing_at(static_cast<double>(line - view.first_line) + 0.5)));
    }

    Water water_;
    RendererOptions options_;
    std::thread::id thread_ = std::this_thread::get_id();
    PathTracer tracer_;
    gl::DrawingCrew crew_;
    std::vector<StrengthTable> strength_;
    std::shared_ptr<PlanCache> plans_;
    PlanCache::Plan plan_;  ///< of the ping at hand
    Workers workers_;
    std::unique_ptr<Summing> fan_, grid_;
    ObjectFinder finder_;
    AcousticChain chain_;
    PathEchoes paths_;
    std::vector<Pixel> pixels_;
    std::vector<Pose> movers_;  ///< of the ping at hand
    RenderProfile profile_;
};

Renderer::Renderer(std::shared_ptr<const Scene> scene, Water water, RendererOptions options) {
    if (!scene) throw std::invalid_argument("renderer: there is no scene");
    impl_ = std::make_unique<Impl>(std::move(scene), water, std::move(options));
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
