// V11: the shadow of a wall on a flat floor.
#include <cmath>

#include "tools/echoloop/validate/groups.h"
#include "tools/echoloop/validate/world.h"

namespace echoloop::validation {

void check_shadow(Findings& find) {
    constexpr double height = 5, top = 1, ground = 20;
    Renderer renderer(scene_of({floor_at(-height, 200), wall_at(ground, 1, -height, top - height)}),
                      water_of(1500), with(only({Effect::spreading})));
    const Shot shot = fan(1, 40, 1, 600, 30);  // level, so that the shadow's end is well off its axis
    const auto values = mean_values(renderer, shot, 64, {});  // over places of the pixels, whose edges blur
    const double bin_size = 30.0 / 600;
    // The wall's own echo ends at its base, 20.62 m away; the floor is dark behind it.
    auto bin = static_cast<std::size_t>(21.5 / bin_size);
    const double lit = values[static_cast<std::size_t>(20.2 / bin_size)];
    std::size_t dark = 0;
    for (; bin < values.size() && values[bin] < 0.25 * lit; ++bin) ++dark;
    const double end = static_cast<double>(bin) * bin_size;
    find.source("h x / (H - h): H 5 m, h 1 m, x 20 m; one bin");
    find.within("length of a wall's shadow on the floor", "m", 5, 1.05 * bin_size,
                dark == 0 ? 0 : std::sqrt(end * end - height * height) - ground);
}

}  // namespace echoloop::validation
