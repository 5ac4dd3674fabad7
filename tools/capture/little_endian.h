// Numbers in makers' files, least byte first. The bytes must be there.
#pragma once

#include <bit>
#include <cstdint>

#include "emulator/contract/device.h"
#include "protocols/wire/read.h"

namespace echoloop::capture::little {

inline std::uint16_t u16(ByteView bytes, std::size_t at) {
    return wire::load<wire::ByteOrder::little, std::uint16_t>(bytes.data() + at);
}
inline std::uint32_t u32(ByteView bytes, std::size_t at) {
    return wire::load<wire::ByteOrder::little, std::uint32_t>(bytes.data() + at);
}
inline std::uint64_t u64(ByteView bytes, std::size_t at) {
    return u32(bytes, at) | std::uint64_t{u32(bytes, at + 4)} << 32;
}
inline double f64(ByteView bytes, std::size_t at) { return std::bit_cast<double>(u64(bytes, at)); }

}  // namespace echoloop::capture::little
