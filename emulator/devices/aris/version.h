// The software that an ARIS of ours says it has. Own choice: one that knows the focus range.
#pragma once

#include <cstdint>

namespace echoloop::aris_device {

inline constexpr std::uint16_t version_major = 2, version_minor = 8;
inline constexpr std::uint32_t version_build = 8883;

}  // namespace echoloop::aris_device
