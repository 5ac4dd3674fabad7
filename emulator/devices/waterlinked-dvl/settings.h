// The options and the profile of a Water Linked DVL as typed values, and what a host can set. Data only.
#pragma once

#include <cstdint>
#include <string>

#include "emulator/devices/family/doppler/settings.h"
#include "emulator/devices/waterlinked-dvl/range_mode.h"

namespace echoloop::waterlinked_dvl {

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

struct Settings : doppler::Settings {
    Settings();

    std::string product;  ///< "DVL A50"
    Configuration start;
    Level level = Level::v2_7_2;
    bool performance = true;
    SerialOutput serial_output = SerialOutput::v1_and_v2;
    double position_rate = 5;         ///< Hz
    bool position_in_uptime = false;  ///< ts counts from the start of the run
    bool line_feed_only = false;      ///< JSON lines end with LF
    bool strict_read = false;         ///< everything of one read is one document
    bool invalid_lines_when_off = false;
    bool water_as_velocity = false;  ///< reports of water tracking have the type `velocity`
    bool commas_in_version = false;
    bool ntp_reached = true;
    bool any_page = false;          ///< a web page from elsewhere may ask
    double boot_time = 0;           ///< s
    double temperature = 30;        ///< degC, inside
    double water_temperature = 10;  ///< degC
    double baud = 115200;           ///< bit/s; 0: not paced
    double unix_start = 0;          ///< s
    std::uint64_t chip_id = 0;

    std::string_view version() const;  ///< "2.7.2"
    std::string_view format() const;   ///< "json_v3.3"
};

void describe(Settings& settings, OptionList& options, FigureList& figures);
/// From complete options and a complete profile.
Settings read_settings(const DeviceConfig& config, std::string_view product);

}  // namespace echoloop::waterlinked_dvl
