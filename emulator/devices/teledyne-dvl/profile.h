// What a Teledyne DVL hears of the water: a profile, or one layer of it, out of the echogram of its ping.
// Pure functions.
#pragma once

#include "emulator/devices/teledyne-dvl/ensemble.h"
#include "render/echogram.h"

namespace echoloop::teledyne_dvl {

/// A ping, and how the vehicle went meanwhile: m/s, x forward, y to starboard, z down, against water that
/// rests.
struct WaterPing {
    const Echogram& echogram;
    Vec3 motion;
    Time began{};
};

/// Velocity, correlation, intensity and percent good of the cells.
std::vector<teledyne::Section> profile_of(const WaterPing& ping, const doppler::Attitude& attitude,
                                          double pulse, const Setup& setup, const Settings& settings);

/// `nearest_bottom`: m, vertical, in the beam with the shortest one; 0: none. A layer never reaches farther
/// than 80 % of that.
WaterLayer layer_of(const WaterPing& ping, double nearest_bottom, const Setup& setup,
                    const Settings& settings);

}  // namespace echoloop::teledyne_dvl
