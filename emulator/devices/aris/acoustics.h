// What a controller asks an ARIS to send and to hear: whether that can be done, and the shot that follows.
// Pure functions.
#pragma once

#include "emulator/devices/aris/settings.h"
#include "protocols/aris/beams.h"
#include "protocols/aris/messages.h"

namespace echoloop::aris_device {

/// In range, of a ping mode that the sonar has, and with time enough for it.
bool is_valid(const aris::SetAcoustics& wish, const Settings& settings);

/// Of valid settings: those with a pulse that the transmitter can bear.
aris::SetAcoustics constrained(const aris::SetAcoustics& wish, const Settings& settings);

const Carrier& carrier_of(const aris::SetAcoustics& acoustics, const Settings& settings);

/// s, from the first transmission to the end of the last ping.
double frame_time(const aris::SetAcoustics& acoustics);

/// All pings of a frame as one, with the next frame as soon as the frame rate lets it. `acoustics` are valid.
Shot make_shot(const aris::SetAcoustics& acoustics, bool telephoto, const Settings& settings,
               std::uint64_t ping);

/// m/s, of water of `temperature` degC and `salinity` ppt at `depth` m.
double sound_speed(double temperature, double salinity, double depth);

}  // namespace echoloop::aris_device
