// The water profile of a Teledyne DVL out of the echogram of its ping. Pure functions.
#pragma once

#include "emulator/devices/teledyne-dvl/ensemble.h"
#include "render/echogram.h"

namespace echoloop::teledyne_dvl {

/// Velocity, correlation, intensity and percent good of the cells. `motion`: m/s of the vehicle, x forward, y
/// to starboard, z down, against water that rests; `began`: of the ping.
std::vector<teledyne::Section> profile_of(const Echogram& echogram, Vec3 motion,
                                          const doppler::Attitude& attitude, double pulse, Time began,
                                          const Setup& setup, const Settings& settings);

}  // namespace echoloop::teledyne_dvl
