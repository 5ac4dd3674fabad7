// The ping that follows from the settings of a 7k sonar: beams, samples, times. Pure functions.
#pragma once

#include <vector>

#include "emulator/devices/family/multibeam/bottom.h"
#include "emulator/devices/reson-7k/settings.h"
#include "render/echogram.h"

namespace echoloop::reson7k_device {

/// What beam widths are at the frequency that is set, as a multiple of those in the profile.
double width_factor(const Controls& controls, const Settings& settings);
/// rad, port to starboard, in equal steps.
std::vector<double> beam_angles(const Settings& settings);
/// Range setting as two-way time by the sound speed that is set, s.
double range_time(const Controls& controls);
/// s from one ping to the next; with a rate of 0, when there are none, the least.
double ping_period(const Controls& controls, const Settings& settings);
/// Hz of the samples of a ping: the profile's, or a whole fraction of it where the range is long.
double sample_rate(const Controls& controls, const Settings& settings);
/// Gates of one beam that looks to `angle`, two-way times.
multibeam::TimeGate bottom_gate(const Controls& controls, double angle);

Shot make_shot(const Controls& controls, const Settings& settings, std::uint32_t ping);

}  // namespace echoloop::reson7k_device
