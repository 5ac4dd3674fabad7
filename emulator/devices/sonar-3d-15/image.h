// One image: the plan of its ping, and the strongest echo of each beam as a pixel. Pure functions of settings
// and echograms.
#pragma once

#include <optional>
#include <vector>

#include "emulator/devices/sonar-3d-15/view.h"

namespace echoloop::sonar_3d_15 {

/// What an image is shot with; it does not change before the image is whole.
struct Plan {
    bool high = false;
    double range_min = 0, range_max = 0;  ///< m
    double speed = 0;                     ///< m/s, as the sonar believes
    std::size_t bins = 0;
    double bin = 0;     ///< m
    double period = 0;  ///< s from the transmission to the image
};

/// `speed`: m/s, the one in use.
Plan make_plan(const State& state, double speed, const Settings& settings);

/// The shot of all beams at once. `number` counts shots and keys the random numbers.
Shot make_shot(const Plan& plan, const View& view, const Settings& settings, std::uint64_t number);

struct Pixel {
    double distance = 0;        ///< m, as the sonar believes
    std::uint8_t strength = 0;  ///< 1..255
};

/// The strongest echo of a beam; nothing if it does not stand out of the noise, lies too far below what beams
/// beside it hear at its range, or reads no strength.
std::optional<Pixel> strongest(const Echogram& echogram, std::size_t beam, const Plan& plan,
                               const Settings& settings);

/// m, between distances that it tells: all 62,000 of six real images lie on a comb of 1.5624 mm, each rounded
/// to the nearest count of its pixel's scale.
inline constexpr double range_step = 1.0 / 640;

/// The range image with its distances as a real sonar has them: each the median of itself and its four
/// neighbours, twice, so that neighbours are often equal. 0 is no distance and stays so.
std::vector<std::uint32_t> smoothed(std::vector<std::uint32_t> distances);

/// m/s, of water near the surface: Mackenzie 1981. `temperature` in degC, `salinity` in ppt.
double automatic_speed(double temperature, double salinity);

}  // namespace echoloop::sonar_3d_15
