// The options and the profile of a Water Linked DVL as typed values, and what a host can set. Data only.
#pragma once

#include <cstdint>
#include <string>

#include "emulator/contract/settings_list.h"
#include "emulator/devices/waterlinked-dvl/range_mode.h"

namespace echoloop::waterlinked_dvl {

/// Figures of the profile, in radians where they are angles.
struct Acoustics {
    double frequency = 0;                              ///< Hz
    double shortest_pulse = 0, longest_pulse = 0;      ///< s
    double source_level = 0;                           ///< dB re 1 uPa at 1 m
    double beam_width = 0;                             ///< two-way
    double lowest_altitude = 0, highest_altitude = 0;  ///< m
    double fastest = 0;                                ///< m/s
    double detection = 0;                              ///< dB above the noise that an echo must have
    double reference_level = 0;                        ///< dB re 1 uPa, reads 0 dBm
    AxisPattern horizontal, vertical;
    Receiver receiver;
};

/// Noise of a beam's velocity: a + b altitude + k speed.
struct Noise {
    double floor = 5e-4;        ///< m/s
    double by_altitude = 2e-4;  ///< m/s per m
    double by_speed = 5e-3;
    double bias = 5e-4;                                       ///< m/s, drifts
    double standard_scale = 0.01, performance_scale = 0.001;  ///< standard deviation among units
    double gyro = 5;                                          ///< deg/h, before calibrate_gyro
};

/// What the host reads and sets; it outlives a boot.
struct Configuration {
    double speed_of_sound = 1500;         ///< m/s
    double mounting_rotation_offset = 0;  ///< deg
    bool acoustic_enabled = true, dark_mode_enabled = false, periodic_cycling_enabled = true;
    RangeMode range_mode;
    friend bool operator==(const Configuration&, const Configuration&) = default;
};

/// Of the software, by what it knows.
enum class Level { v2_2, v2_4, v2_6, v2_7_1, v2_7_2 };

/// What `wcp` chooses.
enum class SerialOutput { off = 0, v1_and_v2 = 1, pd6 = 2, v2 = 3, pd4 = 6 };

struct Settings {
    std::string product;  ///< "DVL A50"
    Configuration start;
    Level level = Level::v2_7_2;
    bool performance = true;
    SerialOutput serial_output = SerialOutput::v1_and_v2;
    double position_rate = 5;         ///< Hz
    bool position_in_uptime = false;  ///< ts counts from the start of the run
    double altitude_offset = 0.015;   ///< m that the altitude reads less
    bool line_feed_only = false;      ///< JSON lines end with LF
    bool strict_read = false;         ///< everything of one read is one document
    bool invalid_lines_when_off = false;
    bool water_as_velocity = false;  ///< reports of water tracking have the type `velocity`
    bool commas_in_version = false;
    bool ntp_reached = true;
    bool any_page = false;          ///< a web page from elsewhere may ask
    double boot_time = 0;           ///< s
    double processing_time = 4e-3;  ///< s, from the last echo to the report
    double temperature = 30;        ///< degC, inside
    double water_temperature = 10;  ///< degC
    double baud = 115200;           ///< bit/s; 0: not paced
    Noise noise;
    double unix_start = 0;  ///< s
    std::uint64_t chip_id = 0;
    Sensors sensors;
    Acoustics acoustics;

    std::string_view version() const;  ///< "2.7.2"
    std::string_view format() const;   ///< "json_v3.3"
    double scale() const { return performance ? noise.performance_scale : noise.standard_scale; }
};

void describe(Settings& settings, OptionList& options, FigureList& figures);
/// From complete options and a complete profile.
Settings read_settings(const DeviceConfig& config, std::string_view product);

}  // namespace echoloop::waterlinked_dvl
