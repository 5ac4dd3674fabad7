// What limits the truth of a scenario's echoes: effects that are off, straight rays in layered water,
// absorption beyond its fit; and a clock that is not that of the world. Words and figures only; draws
// nothing.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "emulator/scenario/scenario.h"
#include "render/refraction.h"

namespace echoloop::cli {

/// In the order of effect_rows; all of them under the paper's rule, which knows none.
std::vector<std::string_view> effects_off(const Scenario& scenario);

/// How far off a device's straight rays are at most, within its range at start-up, where the effect
/// refraction is off.
struct RayBound {
    std::string device;
    double range = 0;  ///< m, slant
    StraightRayError error;
};
/// One for each device; none without a profile of sound speed, or where rays bend.
std::vector<RayBound> ray_bounds(const Scenario& scenario);

/// Sentences of what may surprise: sonars that deafen each other, a sound speed that is not used, absorption
/// beyond its fit.
std::vector<std::string> warnings(const Scenario& scenario);

/// How the run's time passes.
std::string clock_text(const Scenario& scenario);

/// The same as lines: a short name and its text.
struct Condition {
    std::string name, text;
};
std::vector<Condition> conditions(const Scenario& scenario);

}  // namespace echoloop::cli
