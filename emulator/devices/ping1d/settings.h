// The options and the profile of a Ping1D as typed values, what a host can set, and the ping that follows.
// Data only.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "emulator/contract/settings_list.h"
#include "emulator/devices/family/ping/serial_rate.h"

namespace echoloop::ping1d {

/// Figures of the profile, in radians where they are angles.
struct Acoustics {
    double frequency = 0;     ///< Hz
    double source_level = 0;  ///< dB re 1 uPa at 1 m
    double beam_width = 0;
    AxisPattern aperture;
    Receiver receiver;
    double nearest_range = 0;    ///< m, that the ring-down of the shortest pulse lasts
    double reference_level = 0;  ///< dB re 1 uPa after TVG: reads 0 at gain 1
    double full_scale = 0;       ///< dB from 0 to 255
    double tvg_spreading = 0;    ///< dB per decade of range; 0 with the effect tvg off
    double tvg_absorption = 0;   ///< dB/m one way; 0 with the effect tvg off
};

/// What a host can change.
struct State {
    std::uint32_t speed_of_sound = 1500000;   ///< mm/s
    std::uint32_t start = 0, length = 10000;  ///< mm
    bool automatic = true;                    ///< range and gain follow the bottom
    std::uint16_t interval = 100;             ///< ms
    std::uint8_t gain = 3;                    ///< 0..6
    bool enabled = true;
    std::uint16_t points = 200;
    bool normalise = false;

    /// s from the pulse to the end of the range.
    double window() const { return 2.0 * (start + static_cast<double>(length)) / speed_of_sound; }
    std::uint16_t transmit_duration() const;  ///< us, at least shortest_pulse
};

/// Emulator options; README.md of this folder explains each.
struct Settings {
    std::uint8_t device_id = 1, device_type = 1, device_model = 1, device_revision = 1;
    State power_up;
    std::array<std::uint8_t, 3> firmware{3, 28, 0}, protocol{1, 0, 0};
    bool nack_requested_id = false;
    bool ack_continuous = true;
    bool always_profile = false;  ///< stream 1300 whatever was asked for
    bool stream_at_start = false;
    bool marks_are_breaks = true;
    double tracking_lag = 0.3;   ///< s; 0: every ping speaks for itself
    double processing_time = 0;  ///< s from the end of the range to the message
    double baud = 0;             ///< bit/s, of ptys and TCP; 0: not paced
    SerialRate line;
    std::uint16_t voltage = 5000;                                        ///< mV
    std::uint16_t processor_temperature = 4000, pcb_temperature = 3500;  ///< 0.01 degC
    Sensors sensors;
    Acoustics acoustics;
};

inline constexpr std::uint32_t shortest_length = 1000, longest_length = 100000;  ///< mm
inline constexpr std::uint16_t shortest_pulse = 20, longest_pulse = 1000;        ///< us

/// Versions whose 1202 and 1213 have no content: before 3.27, but for the open firmware, which is 0.0.0.
bool is_old(const Settings& settings);
/// From complete options and a complete profile. std::invalid_argument if a version is none.
Settings read_settings(const DeviceConfig& config);
void describe(Settings& settings, OptionList& options, FigureList& figures);

Shot shot_from(const State& state, const Settings& settings);

}  // namespace echoloop::ping1d
