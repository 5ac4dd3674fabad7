#include "tools/echoloop/bench/measure.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <ctime>
#include <fstream>
#include <memory>
#include <optional>

#include "emulator/machine/scheduling.h"
#include "emulator/water/render_threads.h"
#include "tools/echoloop/bench/child_process.h"
#include "tools/echoloop/bench/scenes.h"

namespace echoloop::bench {
namespace {

constexpr std::uint64_t warm_up = 5;  ///< pings that only fill caches
/// Of a case that takes turns: pings that count, and before them those that fill the processor's caches
/// again.
constexpr std::size_t turn_length = 10, refill = 2;

double wall_time() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// s that all threads of this process have computed.
double cpu_time() {
    timespec t{};
    ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

double resident_mb() {
    std::ifstream statm("/proc/self/statm");
    double size = 0, resident = 0;
    statm >> size >> resident;
    return resident * static_cast<double>(::sysconf(_SC_PAGESIZE)) / 1e6;
}

double peak_mb() {
    rusage usage{};
    ::getrusage(RUSAGE_SELF, &usage);
    return static_cast<double>(usage.ru_maxrss) * 1024 / 1e6;
}

std::shared_ptr<const Scene> make_scene(const Case& the_case, const Settings& settings) {
    if (settings.scene_file.empty()) return Scene::from_own_meshes(scene_meshes(the_case.scene));
    return Scene::load(settings.scene_file);
}

/// The values of one quantity, ping by ping.
struct Series {
    std::vector<double> wall, cpu, cull, draw, read_back, bins, paths, acoustics, triangles, pixels;

    void add(double wall_s, double cpu_s, const RenderProfile& p) {
        wall.push_back(1e3 * wall_s);
        cpu.push_back(1e3 * cpu_s);
        cull.push_back(1e3 * p.cull);
        draw.push_back(1e3 * p.draw);
        read_back.push_back(1e3 * p.read_back);
        bins.push_back(1e3 * p.bins);
        paths.push_back(1e3 * p.paths);
        acoustics.push_back(1e3 * p.acoustics);
        triangles.push_back(static_cast<double>(p.triangles));
        pixels.push_back(static_cast<double>(p.pixels));
    }

    void write_to(Figures& f) const {
        f.wall = spread_of(wall);
        f.cpu = spread_of(cpu);
        f.cull = spread_of(cull).median;
        f.draw = spread_of(draw).median;
        f.read_back = spread_of(read_back).median;
        f.bins = spread_of(bins).median;
        f.paths = spread_of(paths).median;
        f.acoustics = spread_of(acoustics).median;
        f.triangles = spread_of(triangles).median;
        f.pixels = spread_of(pixels).median;
    }
};

/// What a case needs to ping.
class Measurement {
  public:
    /// Renders the first ping and those that only fill caches.
    Measurement(const Case& the_case, EchoRule rule, const Settings& settings) : case_(the_case) {
        const double start = wall_time(), start_cpu = cpu_time();
        const auto scene = make_scene(the_case, settings);
        return_freed_memory();  // as `echoloop run` does
        RendererOptions options;
        options.rule = rule;
        options.pixel_density = settings.pixel_density;
        options.context = settings.context;
        options.sampler = settings.sampler;
        options.drawing_threads = RenderThreads::drawing_threads(1);
        keep_rasterisers_on_their_threads();
        options.surface->wind = 1.5;  // what a scenario's water is when it says nothing
        Water water;
        water.scattering = {{0, -95}};
        if (!the_case.profile.empty()) {
            options.surface->height = depth_of_profiles;
            straight_.emplace(scene, water, options);
            water.profile = the_case.profile;
        }
        renderer_.emplace(scene, water, options);
        renderer_->render(shot_of(the_case, 0), pose_of(0));
        figures_.start_up = wall_time() - start;
        figures_.start_up_cpu = cpu_time() - start_cpu;
        figures_.scene_triangles = static_cast<double>(scene->triangles());
        copy_text(figures_.context, renderer_->context_description());
        for (std::uint64_t i = 0; i < warm_up; ++i) render(false);
    }

    /// So many pings, after `uncounted` more.
    void render(std::size_t uncounted, std::size_t counted) {
        for (std::size_t i = 0; i < uncounted + counted; ++i) render(i >= uncounted);
        figures_.turn = {median_of_last(counted, series_.wall), median_of_last(counted, series_.cpu)};
    }

    Figures figures() const {
        Figures figures = figures_;
        series_.write_to(figures);
        figures.straight_cpu = spread_of(straight_cpu_).median;
        figures.resident = resident_mb();
        figures.peak = peak_mb();
        return figures;
    }

  private:
    Case case_;
    std::optional<Renderer> renderer_, straight_;  // take turns, since the speed of a machine varies
    std::uint64_t ping_ = 0;
    Series series_;
    std::vector<double> straight_cpu_;
    Figures figures_;

    void render(bool counts) {
        const Shot shot = shot_of(case_, ++ping_);
        if (straight_) {
            const double cpu = cpu_time();
            straight_->render(shot, pose_of(ping_));
            if (counts) straight_cpu_.push_back(1e3 * (cpu_time() - cpu));
        }
        const double wall = wall_time(), cpu = cpu_time();
        const Echogram echogram = renderer_->render(shot, pose_of(ping_));
        if (counts) series_.add(wall_time() - wall, cpu_time() - cpu, renderer_->profile());
    }

    static double median_of_last(std::size_t count, const std::vector<double>& values) {
        return spread_of({values.end() - static_cast<std::ptrdiff_t>(count), values.end()}).median;
    }
};

/// Makes the case when it is called first, and renders a turn of its pings at every further call.
class Turns {
  public:
    Turns(const Case& the_case, EchoRule rule, const Settings& settings, std::size_t length)
        : case_(the_case), rule_(rule), settings_(settings), length_(length), left_(settings.pings) {}

    Figures operator()() {
        if (measurement_ == nullptr) {
            measurement_ = std::make_shared<Measurement>(case_, rule_, settings_);
            return measurement_->figures();
        }
        const std::size_t counted = std::min(length_, left_);
        left_ -= counted;
        measurement_->render(refill, counted);
        return measurement_->figures();
    }

  private:
    Case case_;
    EchoRule rule_;
    Settings settings_;
    std::size_t length_, left_;
    std::shared_ptr<Measurement> measurement_;
};

}  // namespace

Spread spread_of(std::vector<double> values) {
    if (values.empty()) return {};
    std::sort(values.begin(), values.end());
    const auto at = [&](double share) {
        return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1) + 0.5)];
    };
    return {values.front(), at(0.5), at(0.99)};
}

std::vector<Measured> measure_in_turns(std::span<const Case> cases, EchoRule rule, const Settings& settings) {
    const std::size_t length = cases.size() == 1 ? settings.pings : turn_length;
    std::vector<ChildProcess<Figures>> processes;
    std::vector<Measured> all(cases.size());
    const auto ask = [&](std::size_t i) {
        if (all[i].figures.failure[0] == '\0') all[i].figures = processes[i].ask();
    };
    for (const Case& c : cases) processes.emplace_back(Turns(c, rule, settings, length));
    for (std::size_t i = 0; i < cases.size(); ++i) ask(i);
    for (std::size_t turn = 0; turn * length < settings.pings; ++turn)
        for (std::size_t n = 0; n < cases.size(); ++n) {
            const std::size_t i = turn % 2 == 0 ? n : cases.size() - 1 - n;  // whatever rises, falls
            ask(i);
            all[i].turns.push_back(all[i].figures.turn);
        }
    return all;
}

}  // namespace echoloop::bench
