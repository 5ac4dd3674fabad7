// The lines of text of PD6 and PD13, as Teledyne's and Water Linked's Doppler logs write them. What each
// holds, fields.h says. Knows no state, time or device.
#pragma once

#include <array>
#include <string>
#include <string_view>

namespace echoloop::waterlinked {

/// Against the bottom or a layer of water.
struct Pd6Track {
    std::array<int, 4> instrument{};     ///< mm/s: x, y, z, error
    std::array<int, 3> ship{}, earth{};  ///< mm/s: to starboard, ahead, vertical; east, north, up
    bool instrument_good = false, ship_good = false, earth_good = false;
    std::array<double, 3> way{};  ///< m: east, north, up
    double range = 0, since = 0;  ///< m to the bottom; s since the last good velocity
};

/// deg; `width`: characters of pitch and roll.
std::string pd6_attitude(double pitch, double roll, double heading, int width);
/// `time`: YYMMDDhhmmsshh; parts per thousand, degC, m, m/s, code of the built-in test.
std::string pd6_time(std::string_view time, double salinity, double temperature, double depth,
                     double sound_speed, int built_in_test);
/// Four lines; `against`: B the bottom, W the water.
std::string pd6_track(char against, const Pd6Track& track);
/// Of PD13: kPa, and dm to the bottom of beams 1 to 4.
std::string pd13_ranges(double pressure, const std::array<double, 4>& ranges);

}  // namespace echoloop::waterlinked
