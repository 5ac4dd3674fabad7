// How long KMALL's structs are. Figures only.
#pragma once

#include "protocols/kmall/info_layouts.h"
#include "protocols/kmall/sensor_layouts.h"
#include "protocols/kmall/water_layouts.h"

namespace echoloop::kmall {

inline constexpr std::string_view command_word = "$KSSIS,";
inline constexpr std::size_t header_size = 20, tail_size = 4;  ///< the size stands again at the end

/// Of the latest version that is known.
template <class T>
inline constexpr std::size_t known_size = *wire::fixed_size<T>();

}  // namespace echoloop::kmall
