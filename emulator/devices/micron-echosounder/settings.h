// The options of a Tritech Micron Echosounder as typed values. Data only.
#pragma once

#include <optional>
#include <vector>

#include "emulator/devices/family/sounder/sounding.h"
#include "protocols/altimeter/line.h"

namespace echoloop::micron_echosounder {

enum class NoEcho { zero, maximum, silent };

struct Settings {
    echosounder::Sounding sounding{.rate = 4, .range = 50, .baud = 9600};
    std::optional<altimeter::Format> format = altimeter::Format::three_decimals;  ///< none: NMEA, $PADBT
    NoEcho no_echo = NoEcho::zero;
    bool free_running = true;  ///< false: it waits to be asked
};

/// From complete options and a complete profile.
Settings read_settings(const DeviceConfig& config);
void describe(Settings& settings, OptionList& options, FigureList& figures);

}  // namespace echoloop::micron_echosounder
