// What a Kongsberg multibeam tells of itself before a file is begun: #IIP, #IOP and #SVP. Pure functions.
#pragma once

#include "emulator/devices/kongsberg-kmall/settings.h"
#include "protocols/kmall/sound_text.h"

namespace echoloop::kongsberg_kmall {

/// Installation: the head is the vessel's reference point, so that all offsets and angles are 0.
/// `water_level`: m below the head (negative: above), as #MRZ says. `header`: its type is set.
kmall::Parameters make_installation(kmall::Header header, const Settings& settings, double water_level);
/// What is set now, in the words of the controller's menus.
kmall::Parameters make_runtime(kmall::Header header, const Settings& settings);
/// #SVP without its header: the water's sound speed at all depths; neither its temperature nor its salinity
/// is known here.
kmall::SoundProfile even_profile(const Settings& settings);
/// The same of what a host has said: from its depths to 12000 m, where the last value goes on.
kmall::SoundProfile profile_of(const kmall::SoundReading& reading, const Settings& settings);

}  // namespace echoloop::kongsberg_kmall
