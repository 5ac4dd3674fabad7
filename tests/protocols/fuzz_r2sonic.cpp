// libFuzzer: one datagram. What parses is written back to the same bytes; only the case of a status section's
// 4th character may change.
#include <cstdlib>

#include "protocols/r2sonic/beams.h"
#include "protocols/r2sonic/codec.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace echoloop::r2sonic;
    const echoloop::wire::ByteView bytes(data, size);
    const auto packet = parse(bytes);
    if (!packet) {
        if (packet.error().what().empty()) std::abort();
        return 0;
    }
    const echoloop::wire::Bytes back = serialise(*packet);
    const bool status = std::holds_alternative<Sth0>(*packet) || std::holds_alternative<Sts0>(*packet);
    if (back.size() != size || (!status && !std::equal(back.begin(), back.end(), data))) std::abort();
    if (const auto* bathymetry = std::get_if<Bth0>(&*packet)) {
        if (angles(*bathymetry).size() != bathymetry->h0.points) std::abort();
        two_way_times(bathymetry->r0);
        quality_of(bathymetry->q0, bathymetry->h0.points);
    }
    return 0;
}
