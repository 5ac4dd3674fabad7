// Snappy's raw block format, both ways. Never reads or writes beyond what the block says, and never allocates
// on a lying length.
#pragma once

#include <optional>

#include "protocols/wire/bytes.h"

namespace echoloop::sonar3d {

/// The longest block that is unpacked, B; an image of 256 x 64 pixels has 49 kB.
inline constexpr std::size_t longest_block = std::size_t{1} << 20;

/// Greedy, with 64 KiB of history, as the format's own description does it.
wire::Bytes snappy_compress(wire::ByteView bytes);

/// Nothing if it is no whole block, or one longer than longest_block.
std::optional<wire::Bytes> snappy_uncompress(wire::ByteView block);

}  // namespace echoloop::sonar3d
