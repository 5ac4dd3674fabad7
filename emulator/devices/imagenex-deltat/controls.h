// What a host or an operator has set on a Delta T, and the ping that follows from it. Pure functions.
#pragma once

#include <cstdint>
#include <vector>

#include "protocols/imagenex/delta_t_messages.h"
#include "render/echogram.h"

namespace echoloop::delta_t {

struct Acoustics;

/// m/s: at which the head samples and the ranges of an 83P hold, whatever the sound speed.
inline constexpr double nominal_sound_speed = 1500;

struct Controls {
    unsigned range = 20;      ///< m
    unsigned gain = 3;        ///< dB
    unsigned sector = 120;    ///< deg
    double beam_width = 1.5;  ///< deg
    unsigned beams = 240;
    unsigned averaging = 1;     ///< pings that make one 83P
    double sound_speed = 1500;  ///< m/s, that hosts are told
    double minimum_range = 0;   ///< m
    int tilt = 0;               ///< deg, that hosts are told
    bool transmit = true;
    bool roll_compensation = false;
    friend bool operator==(const Controls&, const Controls&) = default;
};

/// Byte order of the sound speed in an EC. `automatic`: big-endian, or little-endian where that is no sound
/// speed of water.
enum class SpeedOrder { automatic, big, little };

/// The controls after an EC: codes that the specification does not have change nothing. `start` are the
/// program's own, which local control brings back.
Controls after(const imagenex::ExternalControl& command, const Controls& before, const Controls& start,
               SpeedOrder order);

/// Whether their pings make one mean: they differ only in what is told to hosts or done with the mean.
bool alike(Controls a, const Controls& b);

/// The beams as an 83P tells them, which are the beams that there are: whole hundredths of a degree.
struct Fan {
    int start = 0;      ///< 0.01 deg from the axis, positive to starboard
    int increment = 0;  ///< 0.01 deg
    std::size_t beams = 0;

    /// rad from the axis.
    std::vector<double> angles() const;
};
Fan fan_of(const Controls& controls);

/// s, that the head listens to one ping.
double window(const Controls& controls);
/// s, of the pulse that goes with the range.
double pulse_length(const Controls& controls);

/// `roll`: rad by which the fan is turned to starboard.
Shot make_shot(const Controls& controls, const Acoustics& acoustics, std::uint64_t ping, double roll,
               double period);

}  // namespace echoloop::delta_t
