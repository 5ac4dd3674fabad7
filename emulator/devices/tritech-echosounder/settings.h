// The options of a Tritech Micron Echosounder as typed values. Data only.
#pragma once

#include <vector>

#include "emulator/devices/family/sounding.h"

namespace echoloop::tritech_echosounder {

enum class Format {
    three_decimals,  ///< "xxx.xxxm" CR LF
    two_decimals,    ///< "xxx.xxm" CR LF
    millimetres,     ///< "dmm" LF
    nmea,            ///< $PADBT
};

enum class NoEcho { zero, maximum, silent };

struct Settings {
    echosounder::Sounding sounding;
    Format format = Format::three_decimals;
    NoEcho no_echo = NoEcho::zero;
    bool free_running = true;  ///< false: it waits to be asked
};

/// From complete options and a complete profile.
Settings read_settings(const DeviceConfig& config);
/// The table that `echoloop list` shows.
std::vector<Option> option_table();

}  // namespace echoloop::tritech_echosounder
