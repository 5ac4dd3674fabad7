// The CRC-32 of IEEE 802.3, as zlib's crc32.
#pragma once

#include "protocols/wire/bytes.h"

namespace echoloop::wire {

std::uint32_t crc32(ByteView bytes);

}  // namespace echoloop::wire
