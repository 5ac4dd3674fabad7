// What Imagenex heads have in common in their options and profiles, as typed values. Data only; knows no
// bytes.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "emulator/contract/model.h"

namespace echoloop::imagenex_head {

/// Figures of the profile, in radians where they are angles.
struct Acoustics {
    double frequency = 0;     ///< Hz, at which the widths hold
    double source_level = 0;  ///< dB re 1 uPa at 1 m
    double beam_width = 0, fan_height = 0;
    AxisPattern horizontal, vertical;
    Receiver receiver;
    double full_scale_level = 0;  ///< dB re 1 uPa at the end of the scale, gains at 0 dB
    double nearest_range = 0;     ///< m, nearer echoes are no profile
    double ring_down_level = 0;   ///< dB re 1 uPa
    double ring_down_decay = 0;   ///< dB per s
    bool tvg = true;              ///< the effect
};

enum class ShotTiming { table, none, fixed };

struct Settings {
    std::uint8_t head_id = 0x10;
    bool strict = false;  ///< commands without the bits slave, send data and transmit are not answered
    std::uint8_t status = 0;
    int ceiling = 127;             ///< of 8-bit echo data
    bool seven_bits_each = false;  ///< 16-bit data as 7 + 7 bits
    bool keep_fc = false;          ///< FC may stand in the echo data
    std::size_t imx_bytes = 252;   ///< of 8-bit data
    ShotTiming timing = ShotTiming::table;
    double fixed_time = 0.1;  ///< s from command to the end of the reply
    bool obey_baud = false;
    double line_rate = 0;          ///< bit/s at which the reply leaves on its own; 0: at once
    double profile_threshold = 0;  ///< of the scale, 0 to 1
    Acoustics acoustics;
};

/// What differs between the heads in the rows of the common options.
struct Defaults {
    std::uint8_t head_id, lowest_id, highest_id;
    std::vector<std::string> status;  ///< hex; the first is the default
    std::vector<std::string> ceilings;
};
std::vector<Option> option_table(const Defaults& defaults);
std::vector<FigureRow> figure_table();

/// From complete options and a complete profile. std::invalid_argument unless there is one endpoint.
Settings read_settings(const DeviceConfig& config);

/// Everything that Imagenex serial heads answer with is timed by this line rate.
inline constexpr double usual_baud = 115200;
/// m/s, what the heads and their hosts calculate with.
inline constexpr double sound_speed = 1500;

}  // namespace echoloop::imagenex_head
