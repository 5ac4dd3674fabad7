// The options and the profile of an EdgeTech 2205 as typed values, what a host can set, and the ping that
// follows. Data only.
#pragma once

#include <array>
#include <cstdint>

#include "emulator/contract/settings_list.h"

namespace echoloop::edgetech_2205 {

inline constexpr std::size_t port_side = 0, starboard_side = 1;

/// Figures of one subsystem: a frequency with its two arrays. Angles in radians.
struct Band {
    double frequency = 0, bandwidth = 0;  ///< Hz, of the chirp
    double pulse_length = 0;              ///< s
    double source_level = 0;              ///< dB re 1 uPa at 1 m, on the axis
    double beam_width = 0;                ///< along the track, two-way
    double directivity_index = 0;         ///< dB
};

/// Figures of the profile.
struct Acoustics {
    std::array<Band, 2> bands;  ///< low, high
    double fan_height = 0;      ///< rad, two-way
    std::array<double, 2> depressions{};
    double starboard_trim = 0;  ///< dB, of its source level against port's
    AxisPattern horizontal, vertical;
    Receiver receiver;
};

enum class Start : std::uint8_t { silent, low, high, both };

/// Emulator options; README.md of this folder explains each.
struct Settings {
    std::uint8_t version = 0x0D;  ///< of the protocol
    bool replies_to_sets = false;
    bool stays_off = false;  ///< after a shutdown
    Start start = Start::silent;
    std::uint32_t samples = 2000;      ///< a side
    double sound_speed = 1500;         ///< m/s, by which it turns ranges into times
    double processing_time = 5e-3;     ///< s, from the last echo to the data and the next ping
    bool navigation = true;            ///< knows where it is
    double unix_start = 0;             ///< s
    std::optional<GeoPlace> origin{};  ///< of the world
    Sensors sensors;
    Acoustics acoustics;
};

/// What a host sets of a subsystem.
struct Subsystem {
    std::array<bool, 2> active{};  ///< sides whose data are wanted
    bool pings = false;
    std::uint32_t trigger = 0;                                        ///< 0 internal, 1 external, 2 coupled
    std::uint32_t range = 50000;                                      ///< mm
    std::uint32_t pulse_select = 0, ping_gain = 0, gain_control = 0;  ///< kept and told, without effect
    std::uint32_t source = 0, divider = 1, delay = 0;                 ///< of a coupling
    std::uint32_t number = 0;                                         ///< of its last ping
};

void describe(Settings& settings, OptionList& options, FigureList& figures);
/// From complete options and a complete profile.
Settings read_settings(const DeviceConfig& config);

/// mm, as a host may ask for; DUNE's bounds.
std::uint32_t limited_range(std::uint32_t range, std::size_t band);
/// ns, from sample to sample.
std::uint32_t interval_of(const Subsystem& subsystem, const Settings& settings);
double ping_time(const Subsystem& subsystem, const Settings& settings);  ///< s, to the data
/// A ping of both sides; sonar frame: x to the bow.
Shot shot_from(const Subsystem& subsystem, std::size_t band, const Settings& settings);

}  // namespace echoloop::edgetech_2205
