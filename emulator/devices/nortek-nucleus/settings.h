// The options and the profile of a Nortek Nucleus as typed values. Data only.
#pragma once

#include <cstdint>
#include <string>

#include "emulator/devices/family/doppler/settings.h"

namespace echoloop::nortek_nucleus {

struct Settings : doppler::Settings {
    Settings();

    double sound_speed = 1500;  ///< m/s
    bool login = true;
    std::string password = "nortek";
    bool starts_at_once = false;
    double temperature = 10;  ///< degC, of the water
    double baud = 115200;     ///< bit/s; 0: not paced
    double unix_start = 0;    ///< s
    std::uint32_t serial_number = 300001;
};

void describe(Settings& settings, OptionList& options, FigureList& figures);
/// From complete options and a complete profile.
Settings read_settings(const DeviceConfig& config);

}  // namespace echoloop::nortek_nucleus
