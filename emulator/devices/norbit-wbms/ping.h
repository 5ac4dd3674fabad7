// The ping that follows from what a host has set on a Norbit WBMS: beams, samples, gates, gain, times. Pure
// functions.
#pragma once

#include <vector>

#include "emulator/devices/family/multibeam/bottom.h"
#include "emulator/devices/norbit-wbms/controls.h"

namespace echoloop::norbit_device {

inline constexpr double full_sample_rate = 78125;  ///< Hz

/// One ping as it goes out.
struct Plan {
    double sound_speed = 1500;          ///< m/s, that the sonar works with
    double sample_rate = 0;             ///< Hz, of soundings
    double direction = 0, opening = 0;  ///< rad, of the swath as it is
    double sign = 1;                    ///< of angles on the wire, against bearings
    std::vector<double> bearings;       ///< rad, port to starboard
    std::vector<multibeam::TimeGate> gates;
    std::size_t samples_per_bin = 1;  ///< so that the echogram's size stays bounded
    std::size_t first_bin = 0;        ///< bins since the transmission
    std::size_t bins = 0;
    double digital_gain = 0;  ///< dB
    double period = 0;        ///< s to the next ping
    double due = 0;           ///< s from the transmission to the packets

    double bin_rate() const { return sample_rate / static_cast<double>(samples_per_bin); }
};
Plan make_plan(const Controls& controls, const Settings& settings, double digital_gain);

Shot make_shot(const Controls& controls, const Plan& plan, const Settings& settings, std::uint32_t ping);

/// The analog gain: g1 dB before t1, g2 dB after t2, linear between; s of two-way time.
struct Vga {
    double t1 = 0, g1 = 0, t2 = 0, g2 = 0;
    double at(double time) const;
};
Vga make_vga(const Controls& controls, const Plan& plan, const Settings& settings);

/// Digital gain of the next ping, dB. `peak`: of full scale, of the last image with its gain `now`.
double next_gain(const Controls& controls, const Settings& settings, double now, double peak);
double first_gain(const Settings& settings);

}  // namespace echoloop::norbit_device
