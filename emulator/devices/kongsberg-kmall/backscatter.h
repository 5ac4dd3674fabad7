// How strong the bottom is: reflectivities, and the seabed image of #MRZ. Pure functions.
#pragma once

#include <span>

#include "emulator/devices/family/multibeam/bottom.h"
#include "emulator/devices/kongsberg-kmall/settings.h"
#include "protocols/kmall/messages.h"
#include "render/echogram.h"

namespace echoloop::kongsberg_kmall {

/// Fills what all soundings tell of levels, their samples, and the two means of the receiver. Detections of
/// the bottom come first among the soundings.
void add_backscatter(kmall::Mrz& mrz, const Settings& settings, const Echogram& echogram,
                     std::span<const multibeam::Detection> detections);

}  // namespace echoloop::kongsberg_kmall
