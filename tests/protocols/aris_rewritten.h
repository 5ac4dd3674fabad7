// Bytes of an ARIS parsed and written back, for the golden files. Knows beacons, parts of frames and
// commands.
#pragma once

#include "protocols/aris/framer.h"

namespace echoloop::aris {

/// Empty if the bytes are none of these.
inline wire::Bytes rewritten(wire::ByteView bytes) {
    Framer framer;
    framer.feed(bytes);
    if (const auto frame = framer.next()) return encode(*frame);
    const auto part = parse_frame_part(bytes);
    if (part && !part->data.empty()) {
        FramePart again = *part;
        if (const auto header = parse_frame_header(part->header)) again.header = encode(*header);
        return encode(again);
    }
    const auto beacon = parse_availability(bytes);
    return beacon ? encode(*beacon) : wire::Bytes{};
}

}  // namespace echoloop::aris
