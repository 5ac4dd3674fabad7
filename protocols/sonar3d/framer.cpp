#include "protocols/sonar3d/framer.h"

#include "protocols/sonar3d/codec.h"

namespace echoloop::sonar3d {

wire::Found<wire::Bytes> PacketFinder::find(wire::ByteView pending, bool finished) const {
    const auto size = packet_size(pending);
    const bool is_cut = !size || *size > pending.size();
    if (is_cut && !finished) return {};
    if (is_cut || *size == 0 || !is_packet(pending.first(*size))) return {wire::bytes_before('R', pending)};
    return {0, *size, wire::Bytes(pending.begin(), pending.begin() + static_cast<std::ptrdiff_t>(*size))};
}

}  // namespace echoloop::sonar3d
