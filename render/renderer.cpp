#include "render/renderer.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <thread>

#include "render/acoustics/rows.h"
#include "render/acoustics/sea_surface.h"
#include "render/fan/arrays.h"
#include "render/fan/closing_speeds.h"
#include "render/fan/focus.h"
#include "render/fan/object_finder.h"
#include "render/fan/patches.h"
#include "render/fan/plan_cache.h"
#include "render/fan/resting_offset.h"
#include "render/fan/reverberation.h"
#include "render/fan/truth.h"
#include "render/gl/drawing_crew.h"
#include "render/gl/egl.h"
#include "render/grid/summing.h"
#include "render/raster/raster_sampler.h"
#include "render/ray_tables.h"
#include "render/rays/ray_sampler.h"
#include "render/recently_used.h"
#include "render/refraction.h"
#include "render/workers.h"

namespace echoloop {
namespace {

void validate(const RendererOptions& options) {
    if (!(options.columns_per_beam >= 1 && options.columns_per_beam <= 64))
        throw std::invalid_argument("renderer: columns_per_beam must be within 1..64");
    if (!(options.pixel_density >= 0.1 && options.pixel_density <= 64))
        throw std::invalid_argument("renderer: pixel_density must be within 0.1..64");
    if (options.sampler != "auto" && options.sampler != "raster" && options.sampler != "native" &&
        options.sampler != "rays")
        throw std::invalid_argument("renderer: sampler must be auto, raster, native or rays");
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

void validate(const Motion& motion) {
    constexpr double most = 100;  // m/s and rad/s
    if (!(norm(motion.velocity) <= most && norm(motion.turning) <= most))
        throw std::invalid_argument("situation: velocities must be finite and within 100 m/s and rad/s");
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
          scene_((check_settings(), std::move(scene))),
          tracer_(scene_, options_.surface, options_.effects),
          plans_(options_.plans ? options_.plans : std::make_shared<PlanCache>()),
          patches_(*scene_),
          fan_(make_fan_summing(workers_)),
          grid_(make_grid_summing(workers_)),
          chain_(options_.effects, options_.speckle) {
        prepare_paths();
        choose_sampler();
        for (const SceneSurface& surface : scene_->surfaces()) {
            material_of_surface_.push_back(surface.material);
            object_of_surface_.push_back(surface.object);
        }
    }

    Echogram render(const Shot& shot, const Situation& situation) {
        const Pose& pose = situation.world_from_sonar;
        start(shot, situation);
        Echogram out{shot, pose, options_.rule, speed_, {}, 0, {}, {}};
        points_.clear(), fresh_.clear();
        for (Heard& heard : arrays_) hear(heard, situation, out);
        const FreshPower fresh{fresh_, RangeSteps::of(shot.bins).bins};
        if (options_.rule == EchoRule::radiometric)
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
        draw(arrays_.front(), situation);
        const FanPlan& plan = *arrays_.front().plan;
        ChannelImage image{plan.lines, plan.samples, {}, {}, {}};
        for (std::size_t sample = 0; sample < plan.samples; ++sample)
            for (std::size_t line = 0; line < plan.lines; ++line)
                add_channels(image, arrays_.front(), line, sample);
        return image;
    }

    const RenderProfile& profile() const { return profile_; }
    const Scene& scene() const { return *scene_; }
    const Water& water() const { return water_; }
    std::string description() const {
        if (native_) return raster::RasterSampler::description();
        if (sampler_) return rays::RaySampler::description();
        return crew_->drawer().description();
    }

  private:
    /// One array's picture, from which its beams are summed.
    struct Heard {
        ArrayShot array;
        PlanCache::Plan plan;
        std::vector<Pixel> pixels;
        std::vector<float> focus;  ///< as BinningInput::focus
        PathEchoes paths;
        std::optional<PingMotion> motion;
        std::optional<Reverberation> water;  ///< none: it is silent
        bool patchy = false;                 ///< materials are uneven
    };

    void check_settings() const {
        echoloop::validate(water_);
        validate(options_);
    }

    /// While contexts are made, as both take long.
    void prepare_paths() {
        if (options_.rule == EchoRule::radiometric) tracer_.prepare();
    }

    bool may_bend() const { return effects().has(Effect::refraction) && !water_.profile.empty(); }

    /// Makes what finds the surfaces. For a large scene, and where rays may bend, no OpenGL is made but a
    /// GPU's.
    void choose_sampler() {
        const std::size_t threads = options_.drawing_threads;
        const bool ours = options_.sampler == "auto" && options_.context == "auto" &&
                          (scene_->triangles() >= least_triangles_for_native || may_bend());
        if (options_.sampler == "rays") {
            sampler_.emplace(scene_, threads);
        } else if (options_.sampler == "native" || (ours && !gl::may_have_gpu())) {
            native_.emplace(scene_, threads);
        } else {
            crew_.emplace([this] { return gl::make_context(options_.context); }, scene_, threads);
            if (!ours || crew_->drawer().context().kind() == gl::gpu_kind) return;
            crew_.reset();
            native_.emplace(scene_, threads);
        }
    }

    Summing& summing_of(const Shot& shot) { return shot.elevations.empty() ? *fan_ : *grid_; }

    /// Throws as render().
    void start(const Shot& shot, const Situation& situation) {
        check(shot, situation);
        auto arrays = echoloop::arrays_of(shot, situation.world_from_sonar);
        arrays_.resize(arrays.size());
        for (std::size_t i = 0; i < arrays.size(); ++i) arrays_[i].array = std::move(arrays[i]);
        profile_ = {};
        bend(shot, situation);
    }

    /// Fills speed_ and rays_: where rays bend by half a bin or more, echoes come as they do.
    void bend(const Shot& shot, const Situation& situation) {
        speed_ = echoloop::sound_speed(water_), rays_ = nullptr;
        if (!may_bend()) return;
        const double surface = options_.surface.value_or(WaterSurface{}).height;
        const double depth = surface - situation.world_from_sonar.position.z;
        speed_ = sound_speed_at(water_.profile, depth_step(depth));
        const double range = end_range(shot), half_bin = speed_ / 4 * shot.bin_interval;
        rays_ = ray_tables_.of(water_.profile, depth, range, options_.surface.has_value());
        if (rays_->straight_error(range) < half_bin)
            rays_ = nullptr;
        else
            rays_nearby_ = ray_tables_.nearby(water_.profile, depth, range, options_.surface.has_value());
    }

    /// Appends the array's beams to `out`, without their acoustics, and its targets to points_.
    void hear(Heard& heard, const Situation& situation, Echogram& out) {
        const Shot& shot = heard.array.shot;
        draw(heard, situation);
        find_motion(heard, situation, out.sound_speed);
        profile_.paths += timed([&] { trace_paths(heard, out.sound_speed); });
        find_strengths(shot, out.sound_speed);
        find_water(heard, situation, out.sound_speed);
        place_patches(heard);
        Summing& summing = summing_of(shot);
        const BinningInput input = binning_input(heard, out.sound_speed);
        profile_.bins += timed([&] {
            std::vector<float> values, fresh;
            summing.sum(input, values, fresh);
            auto truth = find_truth(summing, input, shot);
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

    template <typename Value>
    static void append(std::vector<Value> part, std::vector<Value>& whole) {
        if (whole.empty()) {
            whole = std::move(part);
            return;
        }
        // g++ 14 takes insert() here for a copy into nothing (-Wstringop-overflow).
        whole.resize(whole.size() + part.size());
        std::ranges::copy(part, whole.end() - static_cast<std::ptrdiff_t>(part.size()));
    }

    void trace_paths(Heard& heard, double c) {
        const Shot& shot = heard.array.shot;
        heard.paths.diffuse.clear(), heard.paths.targets.clear();
        if (options_.rule != EchoRule::radiometric || !tracer_.needed()) return;
        tracer_.trace(shot, heard.array.world_from_sonar, c, absorption(shot), end_range(shot), heard.paths,
                      movers_, heard.motion ? heard.motion->turning : Vec3{}, rays_.get());
        if (heard.motion && heard.motion->shifts) shift_paths(*heard.motion, heard.paths);
    }

    /// rad/s, about the fan's axes.
    static Vec3 turning_of(const Heard& heard, const Situation& situation) {
        const Quat world_from_fan =
            echoloop::world_from_fan(heard.array.shot, heard.array.world_from_sonar).orientation;
        return rotate(conjugate(world_from_fan) * situation.world_from_sonar.orientation, situation.turning);
    }

    /// Fills in the motion of what is drawn.
    void find_motion(Heard& heard, const Situation& situation, double c) {
        heard.motion.reset();
        if (options_.rule != EchoRule::radiometric) return;
        const Quat world_from_fan =
            echoloop::world_from_fan(heard.array.shot, heard.array.world_from_sonar).orientation;
        const Motion own{situation.velocity, turning_of(heard, situation)};
        heard.motion = motion_of(heard.array.shot, *heard.plan,
                                 {world_from_fan, situation.world_from_sonar.position, own, movers_,
                                  situation.mover_motions, mover_of_surface()},
                                 options_.effects, c);
    }

    /// As PingMoves has it.
    const std::vector<std::uint32_t>& mover_of_surface() {
        if (mover_of_surface_.empty() && !scene().movers().empty()) {
            std::vector<std::uint32_t> of_object(scene().objects().size());
            for (const SceneChunk& chunk : scene().chunks()) of_object[chunk.object] = chunk.mover;
            for (const std::uint32_t object : object_of_surface_)
                mover_of_surface_.push_back(of_object[object]);
        }
        return mover_of_surface_;
    }

    /// Fills strength_. Facets' lobes are those of the mirrors that multipath is about.
    void find_strengths(const Shot& shot, double c) {
        const double wavenumber =
            effects().has(Effect::multipath) ? 2 * std::numbers::pi * shot.frequency / c : 0;
        const auto& tables = tables_
                                 .get([&](const Strengths& known) { return known.wavenumber == wavenumber; },
                                      [&] {
                                          Strengths made{wavenumber, {}};
                                          for (const Material& material : scene().materials())
                                              made.tables.emplace_back(material, wavenumber);
                                          return std::pair(std::move(made), std::size_t{1});
                                      })
                                 .tables;
        strength_.clear();
        for (const std::uint32_t material : material_of_surface_) strength_.push_back(&tables[material]);
    }

    /// Fills heard.water, and gives the water's surface a strength behind those of the scene's. What comes
    /// late of the ping before is far weaker than what this one's water sends back, and left out.
    void find_water(Heard& heard, const Situation& situation, double c) {
        heard.water.reset();
        const Shot& shot = heard.array.shot;
        const double z = heard.array.world_from_sonar.position.z;
        const auto surface =
            options_.surface && z < options_.surface->height ? options_.surface : std::nullopt;
        const double wind = options_.surface ? options_.surface->wind : 0;
        if (!effects().has(Effect::reverberation) || situation.detail < 1) return;
        if (water_.scattering.empty() && !(surface && wind > 0)) return;
        strength_.push_back(&surface_strength(shot.frequency, wind));
        WaterAround around{
            .up =
                rotate(conjugate(world_from_fan(shot, heard.array.world_from_sonar).orientation), {0, 0, 1}),
            .depth = surface ? surface->height - z : water_.depth,
            .surface_number = static_cast<float>(strength_.size()),
            .scattering = water_.scattering,
            .near = near_ranges(shot, c / shot.frequency),
            .rays = rays_.get()};
        if (surface) around.surface = surface->height - z;
        heard.water.emplace(around, c / 2 * shot.first_bin_time, c / 2 * shot.bin_interval, shot.bins);
    }

    void place_patches(Heard& heard) {
        heard.patchy = patches_.any() && effects().has(Effect::texture);
        if (heard.patchy)
            patches_.place(world_from_fan(heard.array.shot, heard.array.world_from_sonar), movers_, rays_);
    }

    const StrengthTable& surface_strength(double frequency, double wind) {
        return surface_tables_
            .get([&](const SurfaceStrength& known) { return known.frequency == frequency; },
                 [&] {
                     const auto at = [&](double sine) { return surface_backscatter(frequency, wind, sine); };
                     return std::pair(SurfaceStrength{frequency, StrengthTable(at)}, std::size_t{1});
                 })
            .table;
    }

    /// Np/m.
    double absorption(const Shot& shot) const {
        return effects().has(Effect::absorption)
                   ? db_to_neper(absorption_db_per_km(water_, shot.frequency) / 1e3)
                   : 0;
    }
    /// m, of the window.
    double end_range(const Shot& shot) const {
        return speed_ / 2 * (shot.first_bin_time + static_cast<double>(shot.bins) * shot.bin_interval);
    }

    /// m; of nothing nearer a pulse still sounds in the window.
    double begin_range(const Shot& shot) const {
        return speed_ / 2 * (shot.first_bin_time - shot.pulse_length);
    }

    /// Which object is in which bin. What is 10 dB below the noise is not there: nobody could hear it.
    void find_objects(Echogram& out) {
        const double bin_length = out.sound_speed / 2 * out.shot.bin_interval;
        const double bins_at_once = std::max(1.0, range_resolution(out.shot, out.sound_speed) / bin_length);
        const double least = 0.1 * out.noise_power / bins_at_once;
        for (const Heard& heard : arrays_) {
            const Shot& shot = heard.array.shot;
            if (heard.patchy)
                patches_.place(world_from_fan(shot, heard.array.world_from_sonar), movers_, rays_);
            std::vector<std::uint16_t> objects(shot.beams() * shot.bins);
            finder_.find(summing_of(shot), binning_input(heard, out.sound_speed), object_of_surface_, least,
                         objects);
            append(std::move(objects), out.objects);
        }
    }

    BinningInput binning_input(const Heard& heard, double c) const {
        const Shot& shot = heard.array.shot;
        return {*heard.plan,
                heard.pixels,
                strength_,
                offset_of(heard.array),
                options_.rule,
                c / 2 * shot.first_bin_time,
                c / 2 * shot.bin_interval,
                shot.bins,
                db_to_power(shot.source_level),
                absorption(shot),
                effects().has(Effect::spreading),
                heard.paths.diffuse,
                heard.focus,
                {},
                heard.water ? &*heard.water : nullptr,
                heard.patchy ? &patches_ : nullptr,
                heard.motion ? &*heard.motion : nullptr};
    }

    /// The paper's rule has no acoustics.
    Effects effects() const {
        return options_.rule == EchoRule::radiometric ? options_.effects : Effects::none();
    }

    SampleOffsets offset_of(const ArrayShot& array) const {
        if (!options_.jitter) return {};
        const Shot& shot = array.shot;
        return {jitter_of(shot.ping),
                resting_offset(shot.random_key, array.world_from_sonar.position, shot.pan)};
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
        validate(Motion{situation.velocity, situation.turning});
        if (situation.mover_motions.size() > movers_.size())
            throw std::invalid_argument("movers: there are motions for more than the scene has");
        for (const Motion& motion : situation.mover_motions) validate(motion);
    }

    /// Fills in the picture and the plan that it follows.
    void draw(Heard& heard, const Situation& situation) {
        const Shot& shot = heard.array.shot;
        FanGeometry geometry = geometry_of(shot, effects());
        geometry.margin = margin_of(shot, effects(), turning_of(heard, situation).z);
        const PlanDensity density{options_.columns_per_beam,
                                  options_.pixel_density * situation.detail * situation.density};
        heard.plan =
            plans_->plan_for(geometry, density, [&] { return summing_of(shot).plan(geometry, density); });
        const bool background = situation.detail < 1;
        const gl::Outlook outlook{.world_from_fan = world_from_fan(shot, heard.array.world_from_sonar),
                                  .movers = movers_,
                                  .end_range = end_range(shot),
                                  .begin_range = background ? begin_range(shot) : 0,
                                  .offset = offset_of(heard.array),
                                  .rays = rays_,
                                  .rays_nearby = rays_nearby_,
                                  .sag = speed_ / 8 * shot.bin_interval};
        const gl::DrawProfile& drawn = find_surfaces(*heard.plan, outlook, heard.pixels);
        heard.focus.clear();
        if (rays_ && rays_->focuses() && effects().has(Effect::spreading))
            find_focus(*heard.plan, offset_of(heard.array),
                       world_from_fan(shot, heard.array.world_from_sonar), *rays_, heard.pixels, heard.focus);
        profile_.cull += drawn.cull, profile_.draw += drawn.draw, profile_.read_back += drawn.read_back;
        profile_.triangles += drawn.triangles, profile_.chunks += drawn.chunks;
        profile_.pixels += drawn.pixels;
    }

    const gl::DrawProfile& find_surfaces(const Picture& picture, const gl::Outlook& outlook,
                                         std::vector<Pixel>& pixels) {
        if (sampler_) return sampler_->sample(picture, outlook, pixels), sampler_->profile();
        if (native_) return native_->sample(picture, outlook, pixels), native_->profile();
        return crew_->draw(picture, outlook, pixels), crew_->profile();
    }

    static void add_channels(ChannelImage& image, const Heard& heard, std::size_t line, std::size_t sample) {
        const FanPlan& plan = *heard.plan;
        const auto& pixels = heard.pixels;
        const std::size_t at = line * plan.samples + sample;
        const View& view = plan.view_of(line);
        const SampleRange nominal = plan.nominal[line];
        const bool seen = pixels[at].surface != 0 && sample >= nominal.first && sample < nominal.last;
        image.intensity.push_back(seen ? pixels[at].cosine : 0);
        image.range.push_back(seen ? pixels[at].range : std::numeric_limits<float>::quiet_NaN());
        image.bearing.push_back(
            static_cast<float>(view.bearing_at(static_cast<double>(line - view.first_line) + 0.5)));
    }

    Water water_;
    RendererOptions options_;
    std::thread::id thread_ = std::this_thread::get_id();
    std::shared_ptr<const Scene> scene_;
    PathTracer tracer_;
    std::optional<gl::DrawingCrew> crew_;  ///< one of these
    std::optional<raster::RasterSampler> native_;
    std::optional<rays::RaySampler> sampler_;
    /// Index into Scene::materials() and Scene::objects() of every surface number, which is Pixel::surface
    /// - 1.
    std::vector<std::uint32_t> material_of_surface_, object_of_surface_;
    struct Strengths {
        double wavenumber;
        std::vector<StrengthTable> tables;  ///< per material
    };
    RecentlyUsed<Strengths> tables_{8};
    struct SurfaceStrength {
        double frequency;
        StrengthTable table;
    };
    RecentlyUsed<SurfaceStrength> surface_tables_{8};
    std::vector<const StrengthTable*> strength_;  ///< of the ping at hand, per surface
    std::shared_ptr<PlanCache> plans_;
    Patches patches_;
    Workers workers_;
    std::unique_ptr<Summing> fan_, grid_;
    ObjectFinder finder_;
    AcousticChain chain_;
    std::vector<Heard> arrays_;      ///< of the ping at hand
    std::vector<PointEcho> points_;  ///< the same, of all its beams
    std::vector<float> fresh_;       ///< the same, see FreshPower
    std::vector<Pose> movers_;       ///< the same
    std::vector<std::uint32_t> mover_of_surface_;
    RayTables ray_tables_;
    double speed_ = 1500;                   ///< m/s, of the ping at hand: ranges are times at this speed
    std::shared_ptr<const RayTable> rays_;  ///< of the ping at hand; null: they are straight
    std::shared_ptr<const RayTable> rays_nearby_;  ///< as Outlook::rays_nearby
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
