// A ping of a Doppler log: its shot, and what each beam's echo says. Pure functions of settings and
// echograms.
#pragma once

#include <optional>

#include "emulator/devices/family/doppler/modes.h"
#include "emulator/devices/family/doppler/settings.h"

namespace echoloop::doppler {

/// What a ping is sent with.
struct Plan {
    Mode mode;
    double pulse = 0;   ///< s
    double window = 0;  ///< s of two-way time, to the end of listening
    double period = 0;  ///< s to the next ping
};
/// `speed`: m/s, the device's own.
Plan make_plan(const Mode& mode, double speed, const Settings& settings);

/// Which of the device's beams each beam of a shot is: bearings of a shot ascend from astern over port.
std::vector<std::size_t> order_of_beams(const Settings& settings);
/// The beams, each a single beam with an array of its own, in that order.
Shot make_shot(const Plan& plan, const Settings& settings, std::uint64_t number);

/// The bottom in one beam.
struct Echo {
    double time = 0;                  ///< s, two-way, to the middle of what the beam sees of the bottom
    double level = 0;                 ///< dB re 1 uPa, of the strongest bin
    std::optional<double> closing{};  ///< m/s, by Doppler; nothing: the echogram tells of no velocities
    double scatter = 0;               ///< m/s, by how much speckle over the footprint lets that stray
};

/// dB/m one way, by Francois & Garrison 1982 at 10 degC, salinity 35, pH 8 and the surface; Hz. A log does
/// not know its water any better.
double usual_absorption(double frequency);

/// Looks for the strongest echo, what spreading and absorption take given back, and takes the centre of the
/// power around it: of a narrow beam over a slope that lies on the axis, where the leading edge does not.
std::optional<Echo> find_bottom_echo(const Echogram& echogram, std::size_t beam, const Settings& settings);

}  // namespace echoloop::doppler
