// What a Wayfinder has to say of a ping. Pure functions.
#pragma once

#include "emulator/devices/dvl-wayfinder/settings.h"
#include "emulator/devices/family/doppler/measurement.h"
#include "protocols/wayfinder/messages.h"

namespace echoloop::dvl_wayfinder {

/// `unix_us`: us, Unix time at which the ping began, by its clock; `began`: by the run's.
wayfinder::Data report_of(const doppler::Measured& measured, std::int64_t unix_us, Time began,
                          const Settings& settings);

}  // namespace echoloop::dvl_wayfinder
