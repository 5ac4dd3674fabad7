// The ping that follows from the controls of a Sonic 20xx: beams, samples, times. Pure functions.
#pragma once

#include <vector>

#include "emulator/devices/family/multibeam/bottom.h"
#include "emulator/devices/r2sonic/settings.h"
#include "protocols/r2sonic/messages.h"
#include "render/echogram.h"

namespace echoloop::r2sonic_device {

inline constexpr double sample_rate = 65280.00390625;  ///< Hz, of all real bathymetry seen

/// How the head hangs in the water, as motion sensors would tell it.
struct Attitude {
    double roll = 0;   ///< rad, positive: starboard down; 0 of a head that looks to the side or ahead
    double pitch = 0;  ///< rad, by which the fan lies abaft of straight down
    double depth = 0;  ///< m
};
Attitude attitude_of(const Pose& world_from_sonar);

/// Beams of a ping, one a point: 256, or 1024 in ultra-high density.
std::size_t beam_count(const Controls& controls);
/// Sound speed that the head works with: commanded, or of its own sensor.
double working_sound_speed(const Controls& controls, const Settings& settings);
/// The same as the head tells it: its sensor scatters.
double shown_sound_speed(const Controls& controls, const Settings& settings, Time now);
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
/// Roll and projector offsets, as A0, A1 and A2 carry them.
r2sonic::More more_of(const Beams& beams);
/// `roll`, rad, turns the sector where it is stabilised. Equi-distant beams are so on a bottom whose normal
/// lies at `normal`, rad, in the head's frame.
Beams beam_angles(const Controls& controls, double roll, double normal);
/// Elevation of the transmit fan, rad: steered, stabilised against `pitch`, cut to the frequency's limit.
double steering(const Controls& controls, double pitch);

/// The bottom as the ping before has found it.
struct Seabed {
    double depth = 0;  ///< m, 0: unknown
    double slope = 0;  ///< rad against the head's face, positive where it is shallower to starboard
};
/// Where the head takes the bottom's normal to lie, rad to starboard of its own axis: as the ping before has
/// found the bottom, or straight down where it has found none.
double bottom_normal(const Seabed& last, double roll);
/// Depth and range gates as set; `last` serves the automatic gates. DGS0 and G0 tell their slope with the
/// other sign, positive where it is deeper to starboard.
multibeam::Gates bottom_gates(const Controls& controls, const Seabed& last);

/// Its bearings and tilt are the true ones: with a wrong sound speed a flat array looks elsewhere than it
/// tells (the manual's chapter on sound velocity: the bottom smiles or frowns).
Shot make_shot(const Controls& controls, const Settings& settings, const Beams& beams, double pitch,
               std::uint32_t ping);

}  // namespace echoloop::r2sonic_device
