// The options and the profile of a Delta T as typed values. Data only.
#pragma once

#include "emulator/contract/settings_list.h"
#include "emulator/devices/family/multibeam/figures.h"
#include "emulator/devices/imagenex-deltat/controls.h"

namespace echoloop::delta_t {

/// Figures of the profile, in radians where they are angles.
struct Acoustics {
    double frequency = 0;     ///< Hz
    double source_level = 0;  ///< dB re 1 uPa at 1 m
    double fan_height = 0;    ///< along the track
    AxisPattern horizontal, vertical;
    Receiver receiver;  ///< its saturation level at 0 dB gain
    ArrayErrors errors;
    double intensity_reference = 0;  ///< dB re 1 uPa after gain: reads 65535
    multibeam::Rule detection;
};

/// What stands in the float fields of an 83P.
enum class Floats { zeros, big, little };

/// Emulator options; README.md of this folder explains each.
struct Settings {
    Controls start;  ///< the program's own, before a host says otherwise
    Acoustics acoustics;
    SpeedOrder speed_order = SpeedOrder::automatic;
    Floats floats = Floats::zeros;
    bool upper_month = true;
    bool fine_ranges = true;  ///< 1 in 5000 of the range, else 1 in 500
    double smoothing = 4;     ///< beam widths on either side over which the bottom is taken as straight
    bool intensity = true;
    bool orientation = true;        ///< pitch, roll and heading are measured
    double frame_rate = 20;         ///< Hz, most pings
    double processing_time = 0.01;  ///< s from the end of the window to the datagram
    bool tvg = true, pulse = true;  ///< the effects of that name
    double unix_start = 0;          ///< s
    std::uint32_t serial = 1001;
    Sensors sensors;
};

void describe(Settings& settings, OptionList& options, FigureList& figures);
/// From complete options and a complete profile.
Settings read_settings(const DeviceConfig& config);

}  // namespace echoloop::delta_t
