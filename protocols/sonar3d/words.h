#pragma once

#include "protocols/wire/bytes.h"

namespace echoloop::sonar3d {

inline std::uint32_t word_at(wire::ByteView bytes, std::size_t at) {
    return wire::load<wire::ByteOrder::little, std::uint32_t>(bytes.data() + at);
}

}  // namespace echoloop::sonar3d
