// The names of R2Sonic's flag bits, for people. Tables only.
#pragma once

#include "protocols/r2sonic/status.h"
#include "protocols/wire/field.h"

namespace echoloop::r2sonic {

inline constexpr wire::NamedValue option_names[] = {{option_bits::truepix_snippets, "TruePix/snippets"},
                                                    {option_bits::depth_3km, "3 km"},
                                                    {option_bits::forward_looking, "forward looking"},
                                                    {option_bits::water_column, "water column"},
                                                    {option_bits::ultra_high_resolution, "UHR"},
                                                    {option_bits::water_column_rx_channels, "rx channels"},
                                                    {option_bits::bottom_fill, "bottom fill"}};

}  // namespace echoloop::r2sonic
