// What a host has set on a Norbit WBMS, and the commands that set it. Pure functions of the command's words;
// knows no time and no echo.
#pragma once

#include <string>
#include <string_view>

#include "emulator/devices/norbit-wbms/settings.h"
#include "protocols/norbit/command.h"

namespace echoloop::norbit_device {

inline constexpr double largest_analog_gain = 40;  ///< dB, the document's

/// Values as they stand in commands, in the commands' units (deg, kHz, us).
struct Controls {
    double power = 0;
    double mode = 1;
    double flip = 1;
    double gate_mode = 1;  ///< 0 range, 1 depth, 2 both
    double gate_tilt = 0;
    double start = 0, stop = 50;                                                ///< m, of gate modes 0 and 1
    double range_start = 0, range_stop = 50, depth_start = 0, depth_stop = 50;  ///< m, of gate mode 2
    double direction = 0;
    double opening = 140;
    double vertical_resolution = 256, horizontal_resolution = 128;
    double tx_direction = 0, tx_opening = 0, tx_beams = 1;
    double decimation = 1;
    double frequency = 400, bandwidth = 80, amplitude = 15, pulse = 500;
    double rate = -1;
    double image_rate = 5;  ///< Hz, of water columns at most; not positive: one with every ping
    double vga = 50;        ///< dB per 100 m of two-way range; 0: the analog gain is constant
    double gain = 0;        ///< dB, analog, where vga is 0
    double autogain = 1;
    double snippet_rate = 18, trigger_mode = 3, sidescan_mode = 1, autogate = 2;
    double sound_velocity = -1;
    double time_source = 0;
    std::string time_server = "0.0.0.0";  ///< told back; no time comes from it

    friend bool operator==(const Controls&, const Controls&) = default;
};

/// Values at power-up.
Controls initial_controls(const Settings& settings);

struct Reply {
    std::string text;  ///< with its line's end
    bool understood = false;
};
/// Obeys one command and answers it. What is out of bounds sets nothing; the answer has the values in force.
Reply obey(const norbit::Command& command, Controls& controls, const Settings& settings, Time now);

}  // namespace echoloop::norbit_device
