// A ping of a Nortek DVL as DF21 or DF22 has it: x, y and two z of its beams, with what is valid of them.
// Pure functions.
#pragma once

#include "emulator/devices/family/doppler/measurement.h"
#include "emulator/devices/nortek-dvl/settings.h"
#include "protocols/nortek/messages.h"

namespace echoloop::nortek_dvl {

/// What a track has beside the measurement.
struct Circumstances {
    std::int64_t trigger = 0;  ///< us, Unix time
    doppler::Plan plan;
    double latency = 0;      ///< s, from the trigger to the report
    double temperature = 0;  ///< degC
    double pressure = 0;     ///< bar
    bool broke = false;      ///< it was woken by a break, not by its power
};

/// A valid beam without a distance (of water) gets that of the layer.
nortek::DvlTrack track_of(const doppler::Measured& measured, const Circumstances& circumstances,
                          const Settings& settings);

}  // namespace echoloop::nortek_dvl
