// The options of an NMEA echosounder as typed values. Data only.
#pragma once

#include <string>
#include <vector>

#include "emulator/devices/family/sounder/sounding.h"
#include "protocols/nmea/sentences.h"

namespace echoloop::nmea_echosounder {

struct Settings {
    echosounder::Sounding sounding;
    nmea::Style style;
    std::vector<std::string> sentences;  ///< formatters in their order: "DPT", "DBT", "MTW", "DBS", "DBK"
    bool range_in_dpt = true;
    bool silent_without_bottom = false;
    double offset = 0;        ///< m, as DPT has it
    double temperature = 10;  ///< degrees Celsius
};

/// From complete options and a complete profile; std::invalid_argument if options contradict each other.
Settings read_settings(const DeviceConfig& config);
void describe(Settings& settings, OptionList& options, FigureList& figures);

}  // namespace echoloop::nmea_echosounder
