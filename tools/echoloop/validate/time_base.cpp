// V3: an echo's bin is floor((2 R / c - t0) / dt); what a driver displays scales with the speed that it
// assumes.
#include <cstdio>

#include "emulator/contract/model.h"
#include "emulator/contract/options.h"
#include "emulator/scenario/profile_section.h"
#include "tools/echoloop/validate/groups.h"
#include "tools/echoloop/validate/world.h"

namespace echoloop::validation {
namespace {

constexpr double time_base_range = 20;

std::size_t bin_of_target(double sound_speed, const Shot& shot) {
    Renderer renderer(scene_of({}, {{"target", {time_base_range, 0, 0}, -10}}), water_of(sound_speed),
                      with(only({Effect::spreading})));
    const Echogram e = renderer.render(shot, {});
    return peak_bin(e.beam(0));
}

/// A ping as the Micron sends it when a driver that assumes 1500 m/s asks for 30 m.
Shot micron_shot() {
    const Model& model = *find_model("tritech-micron");
    DeviceConfig config;
    config.options = default_options(model);
    config.profile = own_profile(model);
    Shot shot = model.default_shot(config, 0, 30);
    shot.pan = 0;
    return shot;
}

}  // namespace

void check_time_base(Findings& find) {
    find.source("floor((2 R / c - t0) / dt), R 20 m, t0 10 ms, dt 40 us");
    Shot shot = fan(2, 2, 1, 1000, 60);
    shot.first_bin_time = 10e-3;
    shot.bin_interval = 40e-6;
    const struct { double sound_speed, bin; } table[] = {{1450, 439}, {1500, 416}, {1531, 403}, {1550, 395}};
    for (const auto& row : table) {
        char name[80];
        std::snprintf(name, sizeof name, "bin of a target, c %.0f m/s", row.sound_speed);
        find.within(name, "bin", row.bin, 1, static_cast<double>(bin_of_target(row.sound_speed, shot)));
    }
    find.source("Mackenzie, JASA 70 (1981) 807, check value", Kind::published);
    find.within("sound speed at 25 C, S 35, 1000 m", "m/s", 1550.744, 0.001,
                mackenzie_sound_speed(25, 35, 1000));
    find.source("20 m times c of the driver over c of the water; half a bin");
    const Shot micron = micron_shot();
    const auto bin = static_cast<double>(bin_of_target(1450, micron));
    find.within("range displayed by a driver that assumes 1500 m/s in water of 1450 m/s", "m", 20.690,
                1500 * micron.bin_interval / 2, 1500 * micron.bin_interval / 2 * (bin + 0.5));
}

}  // namespace echoloop::validation
