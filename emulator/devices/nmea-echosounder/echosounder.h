// An echosounder that talks NMEA 0183. What it says; family/talking_sounder.h has when and of what.
#pragma once

#include "emulator/devices/nmea-echosounder/settings.h"

namespace echoloop::nmea_echosounder {

/// The sentences of one ping, in order.
std::vector<std::string> sentences(const Settings& settings, nmea::Depth depth, Time now);

/// The row of the table of models.
Model model();

}  // namespace echoloop::nmea_echosounder
