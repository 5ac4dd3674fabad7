// The ping that follows from the controls of a Sonic 2024: beams, samples, times. Pure functions.
#pragma once

#include <vector>

#include "emulator/devices/family/multibeam_bottom.h"
#include "emulator/devices/r2sonic/settings.h"
#include "protocols/r2sonic/messages.h"
#include "render/echogram.h"

namespace echoloop::r2sonic_device {

inline constexpr std::size_t beams = 256;
inline constexpr double sample_rate = 65280;  ///< Hz, of all real pings seen

/// Sound speed that the head works with: commanded, or of its own sensor.
double working_sound_speed(const Controls& controls, const Settings& settings);
/// Range setting as two-way time, s.
double range_time(const Controls& controls, const Settings& settings);
/// Time from one ping to the next, s: range time + 10 ms (as real heads run freely), or the limited rate.
double ping_period(const Controls& controls, const Settings& settings);
/// Range samples of one ping before compression; a few more than the range setting needs.
std::size_t samples(const Controls& controls, const Settings& settings);
/// Samples that one bin of the echogram holds, so that its size stays bounded.
std::size_t samples_per_bin(std::size_t samples);
/// Receive beam width across, transmit beam width along track, rad, at the commanded frequency.
double receive_beam_width(const Controls& controls, const Acoustics& acoustics);
double transmit_beam_width(const Controls& controls, const Acoustics& acoustics);

/// Beam angles, rad, port to starboard, exactly those that a reader of `section` computes.
struct Beams {
    std::variant<r2sonic::A0, r2sonic::A2> section;
    std::vector<double> angles;
};
Beams beam_angles(const Controls& controls);

/// Depth and range gates as set; `last_depth` (m, 0: unknown) serves the automatic gates.
multibeam::Gates bottom_gates(const Controls& controls, double last_depth);

Shot make_shot(const Controls& controls, const Settings& settings, const Beams& beams, std::uint32_t ping);

}  // namespace echoloop::r2sonic_device
