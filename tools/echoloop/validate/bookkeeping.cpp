// V16: levels do not depend on pixels or triangles.
#include <algorithm>
#include <cmath>

#include "tools/echoloop/validate/groups.h"
#include "tools/echoloop/validate/world.h"

namespace echoloop::validation {
namespace {

std::shared_ptr<const Scene> scene(int cells, int rings) {
    return scene_of({floor_at(-5, 60, cells), wall_at(25, 10, -5, 2), sphere({12, 2, -3.5}, 1, rings, -20)});
}

std::vector<double> heard(const std::shared_ptr<const Scene>& scene, double pixel_density) {
    RendererOptions options =
        with(only({Effect::spreading, Effect::absorption, Effect::beam_pattern, Effect::pulse}));
    options.pixel_density = pixel_density;
    Renderer renderer(scene, water_of(1500), options);
    Shot shot = fan(60, 20, 64, 500, 40);
    shot.tilt = deg_to_rad(-14);
    return mean_values(renderer, shot, 16);
}

double mean_level(const std::vector<double>& values) {
    double sum = 0;
    for (const double v : values) sum += v / static_cast<double>(values.size());
    return db(sum);
}

/// Mean of the differences of the levels of bins, over those with an echo in both.
double mean_difference(const std::vector<double>& a, const std::vector<double>& b) {
    const double threshold = 1e-6 * *std::max_element(a.begin(), a.end());
    double sum = 0;
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        if (a[i] > threshold && b[i] > threshold) sum += db(a[i] / b[i]), ++count;
    return sum / static_cast<double>(count);
}

/// Values that differ when another renderer renders the same ping of a demanding shot, every effect on.
std::size_t differing_values() {
    Shot shot = fan(60, 20, 64, 500, 40);
    shot.tilt = deg_to_rad(-14);
    shot.interval = 0.1;
    shot.receiver = {0, 20, 30, 190, 16};
    shot.ping = 7;
    const auto ping = [&](bool another_before) {
        Renderer renderer(scene(20, 24), water_of(1500));
        if (another_before) renderer.render(fan(3, 30, 1, 300, 20), {{1, 2, 0}, {}});
        return renderer.render(shot, {{0, 0, -1}, from_rpy(0, 0, 0.1)}).values;
    };
    const auto a = ping(false), b = ping(true);
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.size(); ++i) count += a[i] != b[i] ? 1 : 0;
    return count;
}

/// uPa^2 in the first bin of a fan that looks into open water, with a wall at 25 m.
double first_bin_of_open_water() {
    Renderer renderer(scene_of({wall_at(25, 10, -5, 2)}), water_of(1500),
                      with(only({Effect::spreading, Effect::beam_pattern, Effect::side_lobes})));
    const Echogram e = renderer.render(fan(60, 20, 64, 500, 40), {});
    double sum = 0;
    for (std::size_t beam = 0; beam < e.beams(); ++beam) sum += e.beam(beam)[0];
    return sum;
}

}  // namespace

void check_bookkeeping(Findings& find) {
    const auto plain = heard(scene(1, 24), 1), more_pixels = heard(scene(1, 24), 2),
               finer = heard(scene(100, 96), 1);
    find.source("levels belong to the scene", Kind::property);
    find.within("mean power with twice the pixels", "dB", 0, 0.2,
                mean_level(more_pixels) - mean_level(plain));
    find.within("mean over the bins of the change with twice the pixels", "dB", 0, 0.2,
                mean_difference(more_pixels, plain));
    find.within("mean power with a finer mesh", "dB", 0, 0.2, mean_level(finer) - mean_level(plain));
    find.within("mean over the bins of the change with a finer mesh", "dB", 0, 0.2,
                mean_difference(finer, plain));
    find.source("open water is silent, also in the first bin", Kind::property);
    find.at_most("power in the first bin where nothing is near", "uPa^2", 0, first_bin_of_open_water());
    find.source("the same seed, scene, shot and pose", Kind::property);
    find.at_most("values that differ when another renderer renders the same ping", "", 0,
                 static_cast<double>(differing_values()));
}

}  // namespace echoloop::validation
