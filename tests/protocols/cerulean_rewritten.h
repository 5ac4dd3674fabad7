// Frames of Cerulean sonars read and written again, for tests.
#pragma once

#include "protocols/cerulean/omniscan_codec.h"
#include "protocols/cerulean/s500_codec.h"
#include "protocols/cerulean/surveyor_codec.h"
#include "protocols/ping/framer.h"

namespace echoloop::cerulean {

/// The first frame, parsed and written back by the first device that knows it; empty if none does.
inline wire::Bytes rewritten(wire::ByteView bytes) {
    ping::Framer framer;
    framer.feed(bytes);
    const auto frame = framer.next();
    if (!frame) return {};
    const std::uint8_t from = frame->header.source, to = frame->header.destination;
    if (const auto message = omniscan::Codec::parse(*frame))
        return omniscan::Codec::encode(*message, from, to);
    if (const auto message = s500::Codec::parse(*frame)) return s500::Codec::encode(*message, from, to);
    if (const auto message = surveyor::Codec::parse(*frame))
        return surveyor::Codec::encode(*message, from, to);
    return {};
}

}  // namespace echoloop::cerulean
