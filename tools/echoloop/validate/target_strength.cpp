// V6: spheres and plates, as point targets of declared strength and as meshes.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "tools/echoloop/validate/groups.h"
#include "tools/echoloop/validate/world.h"

namespace echoloop::validation {
namespace {

constexpr double sphere_range = 40;

/// Target strength that the echo tells, as the mean over places of the pixels: what is in the window, with
/// the loss of `sphere_range` m taken out.
double strength_of(const std::shared_ptr<const Scene>& scene, Effects effects) {
    Renderer renderer(scene, water_of(1500), with(effects));
    Shot shot = fan(2, 2, 1, 60, 2);
    shot.first_bin_time = 2 * (sphere_range - 1) / 1500;
    shot.pulse_length = 4 * shot.bin_interval;
    const auto values = mean_values(renderer, shot, 32, {});
    const double echo = effects.has(Effect::pulse) ? *std::max_element(values.begin(), values.end())
                                                   : std::accumulate(values.begin(), values.end(), 0.0);
    return db(echo) - shot.source_level + 40 * std::log10(sphere_range);
}

double declared(double target_strength) {
    return strength_of(scene_of({}, {{"target", {sphere_range, 0, 0}, target_strength}}),
                       only({Effect::spreading, Effect::pulse}));
}

double lambert_ball(double mu_db, int rings) {
    return strength_of(scene_of({sphere({sphere_range, 0, 0}, 0.5, rings, mu_db)}),
                       only({Effect::spreading}));
}

}  // namespace

void check_target_strength(Findings& find) {
    find.source("rigid sphere, geometric: 20 log10(a / 2)");
    find.within("declared sphere, a 0.1 m", "dB", -26.02, 0.1, declared(20 * std::log10(0.1 / 2)));
    find.within("declared sphere, a 0.5 m", "dB", -12.04, 0.1, declared(20 * std::log10(0.5 / 2)));
    find.source("plate at normal incidence: 20 log10(A / lambda)");
    find.within("declared plate, 0.1 x 0.1 m, 750 kHz", "dB", 13.98, 0.1,
                declared(20 * std::log10(0.1 * 0.1 / (1500 / 750e3))));
    find.source("Lambert sphere: 10 log10(2 pi mu a^2 / 3)");
    find.within("mesh sphere, a 0.5 m, mu 1/pi", "dB", -7.78, 0.3,
                lambert_ball(db(1 / std::numbers::pi), 32));
    const double coarse = lambert_ball(-27, 16), fine = lambert_ball(-27, 64);
    find.within("mesh sphere, a 0.5 m, mu -27 dB", "dB", -29.81, 0.3, lambert_ball(-27, 32));
    find.source("a mesh four times finer is the same sphere", Kind::property);
    find.within("mesh sphere, 16 to 64 rings", "dB", 0, 0.3, fine - coarse);
    find.source("Lambert plate: 10 log10(mu A), 0.4 x 0.4 m, mu -27 dB");
    find.within("mesh plate at normal incidence", "dB", -34.96, 0.3,
                strength_of(scene_of({wall_at(sphere_range, 0.2, -0.2, 0.2)}), only({Effect::spreading})));
}

}  // namespace echoloop::validation
