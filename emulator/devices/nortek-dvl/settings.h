// The options and the profile of a Nortek DVL as typed values. Data only.
#pragma once

#include <cstdint>
#include <string>

#include "emulator/devices/family/doppler/settings.h"
#include "emulator/devices/family/nortek/login.h"

namespace echoloop::nortek_dvl {

/// What a ping goes out at.
enum class Trigger { internal, command, rise, fall, edges };

struct Settings : doppler::Settings {
    Settings();

    std::string product;        ///< "DVL1000"
    double sound_speed = 1500;  ///< m/s; 0: measured
    double salinity = 35;       ///< parts per thousand
    double rate = 4;            ///< Hz
    Trigger trigger = Trigger::internal;
    double trigger_rate = 0;                    ///< Hz, of pulses on the trigger line; 0: none
    int bottom_format = 21, water_format = 22;  ///< the maker's numbers
    bool water_track = false;
    double water_layer = 3;  ///< m, vertical, to the middle of the water that is tracked
    bool slant_distance = false;
    nortek_console::Login::Kind login = nortek_console::Login::Kind::user;
    std::string password;  ///< empty: any
    bool greeting = true;
    bool starts_at_once = true;
    double temperature = 10;  ///< degC, of the water
    double voltage = 24;      ///< V, of the supply
    double baud = 115200;     ///< bit/s; 0: not paced
    double unix_start = 0;    ///< s
    std::uint32_t serial_number = 100500;
};

void describe(Settings& settings, OptionList& options, FigureList& figures);
/// From complete options and a complete profile.
Settings read_settings(const DeviceConfig& config, const std::string& product);

}  // namespace echoloop::nortek_dvl
