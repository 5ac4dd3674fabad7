// The range modes of a Water Linked DVL. Pure functions.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "emulator/devices/family/doppler/modes.h"

namespace echoloop::waterlinked_dvl {

using doppler::Mode, doppler::Modes;

/// What a host sets: "auto", "=2", "1<=3", or "wt" (water tracking).
struct RangeMode {
    std::size_t lowest = 0, highest = 4;
    std::string text = "auto";
    bool water = false;
    friend bool operator==(const RangeMode&, const RangeMode&) = default;
};
std::optional<RangeMode> read_range_mode(std::string_view text);

/// Of altitudes and rates. `highest_altitude`: of the device, m, where the last mode ends.
Modes range_modes(double highest_altitude);
/// Of water tracking: the layer instead of altitudes.
inline constexpr Mode water_layer{1.5, 4.5, 2};

}  // namespace echoloop::waterlinked_dvl
