// From received power to the numbers that a Sonic sends: gain, time-varied gain, full scale. Pure functions.
#pragma once

#include <vector>

#include "emulator/devices/r2sonic/ping.h"

namespace echoloop::r2sonic_device {

/// Factor on the power of each bin of an echogram, so that 1 is full scale: `full_scale` dB re 1 uPa after
/// gain and time-varied gain. `brightness` dB more.
std::vector<float> gain_curve(const Controls& controls, const Settings& settings, const Echogram& echogram,
                              double full_scale, double brightness = 0);

/// A beam's amplitudes, 0 to 1, at the gain of each bin; under the paper's rule the values as they are. `out`
/// has room for all bins.
void amplitudes(const Echogram& echogram, std::size_t beam, const std::vector<float>& gain, float* out);

/// 0 to `most` for 0 to 1.
void quantise(const float* amplitude, std::size_t count, std::uint8_t* out);
void quantise(const float* amplitude, std::size_t count, std::uint16_t* out);

}  // namespace echoloop::r2sonic_device
