// Imagenex bytes read and written again, for tests.
#pragma once

#include "protocols/imagenex/codec.h"

namespace echoloop::imagenex {

/// The message or shot of a file that the bytes are, parsed and written back; empty if they are none.
inline wire::Bytes rewritten(wire::ByteView bytes) {
    if (const auto shot = parse_shot(bytes)) return encode(*shot);
    const auto message = parse(bytes);
    return message ? encode(*message) : wire::Bytes{};
}

}  // namespace echoloop::imagenex
