#include "tools/echoloop/bench/measure.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <ctime>
#include <fstream>

#include "emulator/machine/scheduling.h"
#include "emulator/water/render_threads.h"
#include "tools/echoloop/bench/child_process.h"
#include "tools/echoloop/bench/scenes.h"

namespace echoloop::bench {
namespace {

constexpr std::uint64_t warm_up = 5;  ///< pings that only fill caches

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

Figures run(const Case& the_case, EchoRule rule, const Settings& settings) {
    Figures figures;
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
    std::optional<Renderer> straight;  // takes turns, since the speed of a machine varies
    if (!the_case.profile.empty()) {
        options.surface->height = depth_of_profiles;
        straight.emplace(scene, water, options);
        water.profile = the_case.profile;
    }
    Renderer renderer(scene, water, options);
    renderer.render(shot_of(the_case, 0), pose_of(0));
    figures.start_up = wall_time() - start;
    figures.start_up_cpu = cpu_time() - start_cpu;
    Series series;
    std::vector<double> straight_cpu;
    for (std::uint64_t ping = 1; ping <= warm_up + settings.pings; ++ping) {
        const Shot shot = shot_of(the_case, ping);
        if (straight) {
            const double cpu = cpu_time();
            straight->render(shot, pose_of(ping));
            if (ping > warm_up) straight_cpu.push_back(1e3 * (cpu_time() - cpu));
        }
        const double wall = wall_time(), cpu = cpu_time();
        const Echogram echogram = renderer.render(shot, pose_of(ping));
        if (ping > warm_up) series.add(wall_time() - wall, cpu_time() - cpu, renderer.profile());
    }
    series.write_to(figures);
    figures.straight_cpu = spread_of(straight_cpu).median;
    figures.resident = resident_mb();
    figures.peak = peak_mb();
    figures.scene_triangles = static_cast<double>(scene->triangles());
    copy_text(figures.context, renderer.context_description());
    return figures;
}

}  // namespace

Spread spread_of(std::vector<double> values) {
    if (values.empty()) return {};
    std::sort(values.begin(), values.end());
    const auto at = [&](double share) {
        return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1) + 0.5)];
    };
    return {values.front(), at(0.5), at(0.99)};
}

Figures measure(const Case& the_case, EchoRule rule, const Settings& settings) {
    return in_child_process<Figures>([&] { return run(the_case, rule, settings); });
}

}  // namespace echoloop::bench
