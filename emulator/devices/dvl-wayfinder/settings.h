// The options and the profile of a Wayfinder as typed values. Data only.
#pragma once

#include <cstdint>

#include "emulator/devices/family/doppler/settings.h"

namespace echoloop::dvl_wayfinder {

enum class Frame : std::uint8_t { beam = 0, instrument = 1 };

struct Settings : doppler::Settings {
    Settings();

    Frame frame = Frame::instrument;
    bool slant_ranges = false;
    double sound_speed = 1500;  ///< m/s, that it begins with
    double most_range = 60;     ///< m, that it begins with
    bool software_trigger = false;
    bool pings_at_start = true;
    double voltage = 24, transmit_voltage = 30, current = 0.2;  ///< V, V, A
    double baud = 115200;                                       ///< bit/s; 0: not paced
    double unix_start = 0;                                      ///< s
    std::uint32_t serial_number = 1234;
};

void describe(Settings& settings, OptionList& options, FigureList& figures);
/// From complete options and a complete profile.
Settings read_settings(const DeviceConfig& config);

}  // namespace echoloop::dvl_wayfinder
