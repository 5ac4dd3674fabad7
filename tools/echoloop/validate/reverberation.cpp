// V25 and V26: what floats in the water, and its surface in the wind.
#include <array>
#include <cmath>
#include <cstdio>

#include "render/acoustics/sea_surface.h"
#include "tools/echoloop/validate/groups.h"
#include "tools/echoloop/validate/world.h"

namespace echoloop::validation {
namespace {

constexpr std::array distances{2.0, 5.0, 10.0, 20.0};

/// RL - SL at those distances of a level head: a line of 3 x 35 deg one way, which is 2.16 x 25.0 deg both
/// ways; 100 us at 700 kHz.
std::array<double, 4> head_levels(Water water, std::optional<WaterSurface> surface) {
    RendererOptions options = with(only({Effect::spreading, Effect::absorption, Effect::beam_pattern,
                                         Effect::side_lobes, Effect::pulse, Effect::reverberation}));
    options.surface = surface;
    water.sound_speed = 1490;
    Renderer renderer(scene_of({}), water, options);
    Shot shot = fan(2.16, 25.0, 1, 500, 25);
    shot.frequency = 700e3, shot.pulse_length = 100e-6;
    const Echogram e = renderer.render(shot, {});
    std::array<double, 4> out{};
    const double bin = 1490 / 2.0 * shot.bin_interval;
    for (std::size_t i = 0; i < out.size(); ++i)
        out[i] = db(e.values[static_cast<std::size_t>(distances[i] / bin)]) - shot.source_level;
    return out;
}

std::string at_distance(const char* what, double range) {
    char name[80];
    std::snprintf(name, sizeof name, "%s at %.0f m", what, range);
    return name;
}

}  // namespace

void check_volume(Findings& find) {
    find.source("RL = SL - 20 log R - 2aR + Sv + 10 log(c tau / 2) + 10 log Psi (Urick 1983, chapter 8)");
    Water water;
    water.scattering = {{0, -60}};
    const auto levels = head_levels(water, {});
    const std::array published{-95.56, -104.72, -112.74, -122.75};
    for (std::size_t i = 0; i < distances.size(); ++i)
        find.within(at_distance("Sv -60 dB, RL - SL", distances[i]), "dB", published[i], 0.3, levels[i]);
}

void check_sea_surface(Findings& find) {
    find.source("APL-UW TR 9407 (1994), II, computed apart from the program");
    const std::array grazing{5.0, 10.0, 30.0, 60.0};
    const struct {
        double khz, wind, bubbles[4], loss;
    } table[] = {{100, 8, {-31.27, -27.28, -24.21, -23.48}, 3.31},
                 {700, 3, {-41.84, -41.72, -41.64, -41.62}, 0.30},
                 {700, 5, {-34.23, -33.23, -32.56, -32.41}, 3.31},
                 {700, 12, {-36.81, -33.82, -29.23, -26.84}, 32.7}};
    char name[80];
    for (const auto& row : table) {
        for (std::size_t i = 0; i < grazing.size(); ++i) {
            std::snprintf(name, sizeof name, "bubbles at %.0f deg, %.0f m/s, %.0f kHz", grazing[i], row.wind,
                          row.khz);
            find.within(name, "dB", row.bubbles[i], 0.1,
                        db(bubble_backscatter(row.khz * 1e3, row.wind, std::sin(deg_to_rad(grazing[i])))));
        }
        std::snprintf(name, sizeof name, "loss of a mirror at 30 deg, %.0f m/s, %.0f kHz", row.wind, row.khz);
        find.within(name, "dB", row.loss, 0.1, surface_bubble_loss_db(row.khz * 1e3, row.wind, 0.5));
    }
    const auto light = head_levels({}, WaterSurface{.height = 1, .wind = 3});
    const auto more = head_levels({}, WaterSurface{.height = 1, .wind = 5});
    const std::array published{-96.0, -92.4, -101.7, -114.5};
    for (std::size_t i = 0; i < distances.size(); ++i)
        find.within(at_distance("1 m below the surface, 3 m/s, RL - SL", distances[i]), "dB", published[i], 1,
                    light[i]);
    find.within(at_distance("5 m/s over 3 m/s", distances.front()), "dB", 9.1, 1,
                more.front() - light.front());
    find.within(at_distance("5 m/s over 3 m/s", distances.back()), "dB", 6.3, 1, more.back() - light.back());
}

}  // namespace echoloop::validation
