// The options and the profile of an Imagenex 872 as typed values, and the ping that a command asks for. Data
// only.
#pragma once

#include <array>
#include <string>

#include "emulator/contract/settings_list.h"
#include "protocols/imagenex/messages.h"

namespace echoloop::imagenex872 {

inline constexpr std::size_t points = 1000;  ///< of a side

/// Figures of one of its three frequencies. Angles in radians.
struct Band {
    double frequency = 0;     ///< Hz
    double source_level = 0;  ///< dB re 1 uPa at 1 m
    double beam_width = 0, fan_height = 0;
};

/// Figures of the profile.
struct Acoustics {
    std::array<Band, 3> bands;
    double pulse_length = 0;  ///< s
    std::array<double, 2> depressions{};
    double starboard_trim = 0;    ///< dB
    double full_scale_level = 0;  ///< dB re 1 uPa at 1 m that reads full scale without gain
    AxisPattern horizontal, vertical;
    Receiver receiver;
};

/// Emulator options; README.md of this folder explains each.
struct Settings {
    std::string header = "IGX";
    double ceiling = 255;  ///< counts
    bool pings_for_starboard = true;
    double sound_speed = 1500;       ///< m/s, by which it turns ranges into times
    double processing_time = 10e-3;  ///< s, from the last echo to the reply
    Acoustics acoustics;
};

void describe(Settings& settings, OptionList& options, FigureList& figures);
Settings read_settings(const DeviceConfig& config);

/// m: a range that it has, at most the one that was asked for.
double range_of(const imagenex::SwitchCommand& command);
std::size_t band_of(const imagenex::SwitchCommand& command);
Shot shot_from(const imagenex::SwitchCommand& command, const Settings& settings);

}  // namespace echoloop::imagenex872
