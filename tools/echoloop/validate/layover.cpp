// V12: what comes first, and what comes too late.
#include <cmath>

#include "emulator/water/second_time_around.h"
#include "tools/echoloop/validate/groups.h"
#include "tools/echoloop/validate/world.h"

namespace echoloop::validation {
namespace {

constexpr double window = 50;

/// Range in m at which the first bin louder than `share` of the loudest begins.
double first_range(const Echogram& e, double share) {
    return e.sound_speed / 2 * e.shot.bin_interval * static_cast<double>(first_bin(e.beam(0), share));
}

/// A wall that stands 5 m below the sonar and ends 1 m below it.
void check_wall(Findings& find) {
    Renderer renderer(scene_of({wall_at(20, 1, -5, -1)}), water_of(1500), with(only({Effect::spreading})));
    Shot shot = fan(1, 40, 1, 1200, 30);
    const Echogram e = renderer.render(shot, {});
    const auto beam = e.beam(0);
    std::size_t last = 0;
    for (std::size_t i = 0; i < beam.size(); ++i)
        if (beam[i] > 0) last = i;
    find.source("sqrt(20^2 + 1^2) and sqrt(20^2 + 5^2); one bin");
    find.within("range of a wall's first echo, its top", "m", 20.025, 0.025, first_range(e, 0));
    find.within("range of its last echo, its base", "m", 20.616, 0.025,
                (static_cast<double>(last) + 0.5) * 0.025);
}

/// A fan that looks 10 to 30 deg down, 6 m above the floor.
void check_first_bottom_return(Findings& find) {
    Shot shot = fan(3, 20, 1, 2000, window);
    shot.tilt = deg_to_rad(-20);
    const auto first = [&](Effects effects) {
        Renderer renderer(scene_of({floor_at(-6, 200)}), water_of(1500), with(effects));
        return first_range(renderer.render(shot, {}), 1e-9);
    };
    Effects effects = only({Effect::spreading, Effect::beam_pattern, Effect::side_lobes});
    find.source("straight down, R = H = 6 m; one bin");
    find.within("first bottom return, through side lobes", "m", 6, 0.025, first(effects));
    find.source("the floor outside the main lobe is silent", Kind::property);
    find.at_least("first bottom return without side lobes", "m", 8,
                  first(effects.set(Effect::side_lobes, false)));
}

/// What the second of two pings hears, `window` m apart, with the late echoes of the first if the effect is
/// on.
Echogram second_ping(const std::shared_ptr<const Scene>& scene, const Effects& effects) {
    constexpr double farthest = 200;
    Renderer renderer(scene, water_of(1500), with(effects));
    Shot shot = fan(3, 20, 1, 500, window);
    shot.interval = 2 * window / 1500;
    SecondTimeAround memory;
    if (const auto late = late_shot(shot, renderer.water(), effects, farthest))
        memory.keep(1, renderer.render(*late, {}));
    Echogram heard = renderer.render(shot, {});
    memory.add_to(2, heard);
    return heard;
}

void check_late_echo(Findings& find, const char* what, const std::shared_ptr<const Scene>& scene) {
    Effects effects = only({Effect::spreading, Effect::pulse});
    find.source("an echo from beyond the window never wraps", Kind::property);
    find.at_most(std::string(what) + " 10 m beyond the window: what is heard", "uPa^2", 0,
                 total(second_ping(scene, effects).values));
    find.source("R - Rmax of the next ping, 60 m - 50 m; two bins");
    const Echogram late = second_ping(scene, effects.set(Effect::second_time_around));
    find.within(std::string(what) + " 10 m beyond the window, second time around", "m", 10, 0.2,
                total(late.values) > 0 ? first_range(late, 0.3) : 0);
}

}  // namespace

void check_layover(Findings& find) {
    check_wall(find);
    check_first_bottom_return(find);
    check_late_echo(find, "target", scene_of({}, {{"target", {60, 0, 0}, 0}}));
    check_late_echo(find, "wall", scene_of({wall_at(60, 0.5, -0.5, 0.5)}));
}

}  // namespace echoloop::validation
