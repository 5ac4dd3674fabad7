// Compressed recordings read as if they were not: gzip as a stream, and what Qt's qCompress makes. The only
// user of zlib.
#pragma once

#include <cstdio>
#include <optional>
#include <string>

#include "emulator/contract/device.h"

namespace echoloop::capture {

/// True for the first two bytes of a gzip file.
bool is_gzip(ByteView start);
/// "bzip2", "xz", "zstd" or "zip", which are not read; "" for anything else. Wants six bytes.
std::string other_compression(ByteView start);

/// What gunzip makes of `head` and of `rest`, which it closes unless it is standard input. At a fault the
/// stream ends, and `fault`, which outlives it, says why. nullptr if there is no memory.
std::FILE* gunzipped(Bytes head, std::FILE* rest, std::string& fault);

/// A length of four bytes, the most significant first, and a zlib stream. Empty if it is damaged or longer
/// than `most`.
std::optional<Bytes> qt_uncompressed(ByteView bytes, std::size_t most);

}  // namespace echoloop::capture
