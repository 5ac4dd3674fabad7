// V7: a Lambert seabed, with speckle, as the mean over many pings.
#include <cmath>
#include <cstdio>

#include "render/acoustics/pattern.h"
#include "render/scene/seabeds.h"
#include "tools/echoloop/validate/groups.h"
#include "tools/echoloop/validate/world.h"

namespace echoloop::validation {
namespace {

constexpr std::size_t pings = 200, seabed_beams = 8;
constexpr double altitude = 5, pulse = 100e-6;
constexpr double seabed_bin = 0.0375;  // m, half of c tau / 2

/// Beams of an effective width of 1 deg, tilted down; those with a pattern so that their axis meets the floor
/// at 20 m.
Shot floor_shot(bool patterned) {
    Shot shot = fan(seabed_beams, 40, seabed_beams, 1200, 45);
    shot.tilt = patterned ? -std::asin(altitude / 20) : deg_to_rad(-22);
    shot.pulse_length = pulse;
    shot.horizontal = {ApertureShape::line, 1};
    // The equivalent width is proportional to the -3 dB width, as these are small.
    if (patterned)
        shot.beam_width *= deg_to_rad(1) / TwoWayPattern(shot.horizontal, deg_to_rad(1)).equivalent_width();
    return shot;
}

/// Mean level re the source over all beams and the bins within 0.2 m of a range; absorption is off.
double level_at(const std::vector<double>& mean, const Shot& shot, double range) {
    double sum = 0;
    std::size_t count = 0;
    for (std::size_t beam = 0; beam < seabed_beams; ++beam)
        for (double r = range - 0.2; r < range + 0.2; r += seabed_bin, ++count)
            sum += mean[beam * shot.bins + static_cast<std::size_t>(r / seabed_bin)];
    return db(sum / static_cast<double>(count)) - shot.source_level;
}

std::vector<double> heard(const Shot& shot, Effects effects) {
    Renderer renderer(scene_of({floor_at(-altitude, 400)}), water_of(1500), with(effects));
    return mean_values(renderer, shot, pings);
}

/// 10 log10 of A = (c tau / 2) phi R / cos g at slant range `range`.
double patch(double range) {
    const double cos_grazing = std::sqrt(1 - altitude * altitude / (range * range));
    return db(1500 * pulse / 2 * deg_to_rad(1) * range / cos_grazing);
}

/// RL - SL by the closed form, for the report's curve.
double closed_form(double range) {
    return -40 * std::log10(range) - 27 + 20 * std::log10(altitude / range) + patch(range);
}

/// Sb in dB of a named seabed at 45 deg, from what a sonar above it hears.
double strength_at_45_deg(const char* seabed) {
    Mesh floor = floor_at(-altitude, 100);
    floor.material = *seabed_by_name(seabed);
    Renderer renderer(scene_of({floor}), water_of(1500), with(only({Effect::spreading, Effect::pulse})));
    Shot shot = floor_shot(false);
    shot.tilt = deg_to_rad(-45);
    const double range = altitude * std::sqrt(2);
    return level_at(mean_values(renderer, shot, 4), shot, range) + 40 * std::log10(range) - patch(range);
}

}  // namespace

void check_seabed(Findings& find) {
    find.source("Mackenzie 1961: -27 dB + 20 log10 sin g; A = (c tau / 2) phi R / cos g; H 5 m, phi 1 deg");
    const Shot boxes = floor_shot(false);
    const auto mean = heard(boxes, only({Effect::spreading, Effect::pulse, Effect::speckle}));
    const struct { double range, published; } table[] = {{10, -91.23}, {20, -106.76}, {40, -121.92}};
    for (const auto& row : table) {
        char name[80];
        std::snprintf(name, sizeof name, "RL - SL at %.0f m, 200 pings with speckle", row.range);
        find.within(name, "dB", row.published, 0.5, level_at(mean, boxes, row.range));
    }
    const Shot patterned = floor_shot(true);
    const auto through_pattern = heard(patterned, only({Effect::spreading, Effect::pulse, Effect::speckle,
                                                        Effect::beam_pattern, Effect::side_lobes}));
    find.within("RL - SL at 20 m, beam of an equivalent width of 1 deg", "dB", -106.76, 0.5,
                level_at(through_pattern, patterned, 20));
    find.source("measured at 200 kHz: sand -36 to -37.5 dB, mud -45 to -47 dB", Kind::published);
    find.within("Sb of sand-200khz at 45 deg", "dB", -36.75, 0.75, strength_at_45_deg("sand-200khz"));
    find.within("Sb of mud-200khz at 45 deg", "dB", -46, 1, strength_at_45_deg("mud-200khz"));
    Curve ours{"200 pings", {}, true}, law{"closed form", {}, false};
    for (double range = 8; range < 44; range += 1) {
        ours.points.emplace_back(range, level_at(mean, boxes, range));
        law.points.emplace_back(range, closed_form(range));
    }
    find.plot(
        "seabed",
        {"Echo of a flat sandy floor, 5 m below", "slant range, m", "RL - SL, dB", {law, ours}, -130, -80});
}

}  // namespace echoloop::validation
