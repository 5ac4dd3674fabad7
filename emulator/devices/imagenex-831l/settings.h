// The options and the profile of an Imagenex 831L as typed values, and what a command asks for. Data and pure
// functions.
#pragma once

#include "emulator/contract/settings_list.h"
#include "emulator/devices/family/imagenex/scan.h"
#include "protocols/imagenex/messages.h"

namespace echoloop::imagenex831l {

inline constexpr std::size_t points = 250;    ///< of the echo data
inline constexpr double resolution = 0.5e-3;  ///< m, of the samples and of the profile range
inline constexpr double sound_speed = 1500;   ///< m/s, by which the head turns times into ranges
inline constexpr std::uint8_t interrogate = 1, calibrate_tilt = 255;  ///< byte 21

/// Figures of the profile. Angles in radians.
struct Acoustics {
    double frequency = 0;     ///< Hz, at which the width holds
    double source_level = 0;  ///< dB re 1 uPa at 1 m
    double beam_width = 0;    ///< of the cone
    AxisPattern horizontal, vertical;
    Receiver receiver;
    double full_scale_level = 0;  ///< dB re 1 uPa at 1 m at the end of the scale, gains at 0 dB
    double nearest_range = 0;     ///< m, nearer echoes are no profile
    bool tvg = true;              ///< the effect
};

enum class ProfileUnit { half_millimetres, centimetres };

/// Emulator options; README.md of this folder explains each.
struct Settings {
    bool reverse_status = false;
    ProfileUnit unit = ProfileUnit::half_millimetres;
    bool subtract_delay = false;  ///< of the filter, which one public reader adds
    imagenex_head::ReverseBit reverse_bit = imagenex_head::ReverseBit::once;
    bool clip = false;
    int start_position = imagenex_head::ahead;
    int ceiling = 127;
    double profile_threshold = 0.5;    ///< of the scale
    double least_time = 3.25e-3;       ///< s, of a shot
    double processing_time = 1.92e-3;  ///< s, from the last echo to the reply
    Acoustics acoustics;
    Sensors sensors;
};

void describe(Settings& settings, OptionList& options, FigureList& figures);
Settings read_settings(const DeviceConfig& config);

/// The command within what the head can do.
imagenex::SwitchCommand usable(imagenex::SwitchCommand command);
/// Byte 4 of a reply.
std::uint8_t status_of(const imagenex::SwitchCommand& command, const Settings& settings);
/// Of a usable command, without the head's direction.
Shot shot_from(const imagenex::SwitchCommand& command, const Settings& settings);

}  // namespace echoloop::imagenex831l
