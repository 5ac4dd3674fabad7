// The `water` of a scenario: its properties, its profile of sound speed and its surface.
#pragma once

#include <optional>

#include "emulator/scenario/section.h"
#include "render/paths/paths.h"
#include "render/water.h"

namespace echoloop::scenario {

/// Where the file names no depth, it is that of `vehicle_z` below the surface (both m, up).
Water read_water(const Section& section, double vehicle_z, double surface_height, Problems& problems);

/// Height and roughness, or none; a calm surface at z = 0 where the file says nothing.
std::optional<WaterSurface> read_surface(const Section& section, Problems& problems);

}  // namespace echoloop::scenario
