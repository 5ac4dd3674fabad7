// The options and the profile of a Kongsberg multibeam as typed values. Data only.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "emulator/contract/settings_list.h"
#include "emulator/devices/family/multibeam/figures.h"

namespace echoloop::kongsberg_kmall {

inline constexpr double position_error = 0.078;  ///< m, of an EM 2042's #SPE on one day

struct Settings {
    // What a host's commands change, at power-up.
    bool pinging = true;
    bool water_column = false;
    double range = 40;                         ///< m, as long as no depth is set
    std::optional<double> max_depth{};         ///< m below the head
    double frequency = 300e3;                  ///< Hz
    double port_edge = 0, starboard_edge = 0;  ///< rad, of the fan, from below
    bool equidistant = false;
    double ping_rate = 5;  ///< Hz, at most
    // What they do not.
    double pulse = 35e-6;  ///< s
    double power = 0;      ///< dB re the source level
    std::size_t soundings = 400;
    bool values_as_xml = false;
    double absorption = 0;     ///< dB/m, that the sounder reckons with
    std::uint8_t version = 3;  ///< of #MRZ
    bool seabed_image = true;
    std::size_t extra_detections = 0;
    std::size_t largest_part = 65000;  ///< B
    bool unused_point = true;          ///< behind those of #SVP
    bool sensor_datagrams = true;
    enum class LaterProfiles { stored, used, refused } later_profiles = LaterProfiles::stored;
    std::uint16_t sounder = 2040;
    std::uint8_t system_id = 40;
    double latitude = 0, longitude = 0;  ///< deg, of the scene's origin
    double datagram_gap = 2e-3;          ///< s
    double processing_time = 5e-3;       ///< s from the last sample to the datagrams
    double probe_interval = 1;           ///< s from one sound speed at the head to the next
    // The profile; beam widths in rad at the frequency.
    double source_level = 0;         ///< dB re 1 uPa at 1 m, at full power
    double reference_frequency = 0;  ///< Hz, of the profile's beam widths
    double receive_beam_width = 0, transmit_beam_width = 0;
    multibeam::Rule detection;
    double water_column_reference = 0;  ///< dB re 1 uPa after gain: reads 0 dB
    AxisPattern horizontal, vertical;
    Receiver receiver;
    ArrayErrors errors;
    // The scenario.
    bool tvg = true, echoes_last = true;
    double sound_speed = 1500;  ///< m/s, of the sounder's own sensor: the true one
    double unix_start = 0;      ///< s
    Sensors sensors;

    /// Of transmitter and receiver: as long as those of real ones, and ours.
    int head_serial() const { return 2000 + system_id; }
    /// Another frequency: beams widen, and the array gathers less noise from around, below the one before.
    void tune(double hertz);
};

void describe(Settings& settings, OptionList& options, FigureList& figures);
/// From complete options and a complete profile.
Settings read_settings(const DeviceConfig& config);

}  // namespace echoloop::kongsberg_kmall
