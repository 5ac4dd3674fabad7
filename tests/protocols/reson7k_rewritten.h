// 7k packets read and written again, for tests.
#pragma once

#include "protocols/reson7k/codec.h"
#include "protocols/reson7k/framer.h"

namespace echoloop::reson7k {

/// The one record that these packets are, parsed and written back with the first packet's network frame;
/// empty if they are none.
inline wire::Bytes rewritten(wire::ByteView bytes) {
    const auto network = plausible_network_frame(bytes);
    Framer framer;
    framer.feed(bytes);
    const auto record = framer.next();
    const auto message = record ? parse(*record) : wire::Result<Message>(wire::Error{});
    if (!network || !message) return {};
    wire::Bytes out;
    for (const auto& packet :
         packets_of(encode(*message, record->frame), network->transmission, network->source_device))
        out.insert(out.end(), packet.begin(), packet.end());
    return out;
}

}  // namespace echoloop::reson7k
