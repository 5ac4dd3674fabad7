// What Imagenex heads have in common in their options and profiles, as typed values. Data only; knows no
// bytes.
#pragma once

#include <cstdint>
#include <initializer_list>

#include "emulator/contract/settings_list.h"

namespace echoloop::imagenex_head {

/// Everything that Imagenex serial heads answer with is timed by this line rate.
inline constexpr double usual_baud = 115200;
/// m/s, what the heads and their hosts calculate with.
inline constexpr double sound_speed = 1500;

/// Figures of the profile, in radians where they are angles.
struct Acoustics {
    double frequency = 0;     ///< Hz, at which the widths hold
    double source_level = 0;  ///< dB re 1 uPa at 1 m
    double beam_width = 0, fan_height = 0;
    AxisPattern horizontal, vertical;
    Receiver receiver;
    double full_scale_level = 0;  ///< dB re 1 uPa at the end of the scale, gains at 0 dB
    double nearest_range = 0;     ///< m, nearer echoes are no profile
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
    double line_rate = usual_baud;  ///< bit/s at which the reply leaves on its own; 0: at once
    double profile_threshold = 0;   ///< of the scale, 0 to 1
    bool two_looks = false;  ///< the noise of a point has two independent values; else one for each sample
    Acoustics acoustics{};
};

/// What differs between the heads in the choices of the common options.
struct Choices {
    std::uint8_t lowest_id, highest_id;
    std::initializer_list<Word<std::uint8_t>> status;
    std::initializer_list<Word<int>> ceilings;
};
void describe(Settings& settings, OptionList& options, FigureList& figures, const Choices& choices);

/// Sets what is neither an option nor a figure. std::invalid_argument unless there is one endpoint.
void complete(Settings& settings, const DeviceConfig& config);

}  // namespace echoloop::imagenex_head
