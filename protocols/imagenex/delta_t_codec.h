// 83P and EC to bytes and back, by their tables. Knows no state, time or device.
#pragma once

#include <optional>
#include <string>

#include "protocols/imagenex/delta_t_messages.h"
#include "protocols/wire/bytes.h"
#include "protocols/wire/result.h"

namespace echoloop::imagenex {

inline constexpr std::size_t control_bytes = 256;         ///< of an EC
inline constexpr std::size_t profile_header_bytes = 256;  ///< of an 83P, before its ranges

/// The message that these bytes are, all of them. Floats are read big-endian.
wire::Result<DeltaTMessage> parse_delta_t(wire::ByteView bytes);
wire::Bytes encode(const DeltaTMessage& message);
/// An 83P whose floats are little-endian, as some readers take them.
wire::Bytes encode_with_little_floats(const Profile83P& profile);

/// Bytes of the message that begins here, by its own word; 0 if none does or it goes on beyond the bytes.
std::size_t delta_t_bytes(wire::ByteView bytes);

/// "83P", "EC".
std::string name_of(const DeltaTMessage& message);

}  // namespace echoloop::imagenex
