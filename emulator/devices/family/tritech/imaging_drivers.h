// What drivers of imaging heads say, and which are known. Rows and bytes only.
#pragma once

#include <vector>

#include "emulator/contract/model.h"
#include "emulator/devices/family/tritech/imaging_settings.h"

namespace echoloop::tritech {

/// See Model::requests and Model::drivers.
std::vector<Bytes> imaging_requests(const DeviceConfig& config, std::size_t pings, bool turns);
std::vector<KnownDriver> imaging_drivers(Family family);

}  // namespace echoloop::tritech
