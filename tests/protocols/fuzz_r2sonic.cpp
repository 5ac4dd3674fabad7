// libFuzzer: one datagram. What parses is written back to the same bytes, but for the case of a status
// section's 4th character and for sections that were skipped or stood in another order; these come back as
// the same packet.
#include <cstdlib>

#include "protocols/r2sonic/beams.h"
#include "protocols/r2sonic/codec.h"
#include "protocols/r2sonic/known_sections.h"
#include "tests/protocols/mutator.h"

namespace {

void check_bathymetry(const echoloop::r2sonic::Bth0& packet) {
    using namespace echoloop::r2sonic;
    if (angles(packet).size() != packet.h0.points) std::abort();
    two_way_times(packet.r0);
    quality_of(packet.q0, packet.h0.points);
}

}  // namespace

ECHOLOOP_MUTATOR({.family = "r2sonic"})

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
    const bool same = back.size() == size && (status || std::equal(back.begin(), back.end(), data));
    if (!same && known_sections(bytes) != back) std::abort();
    if (const auto* bathymetry = std::get_if<Bth0>(&*packet)) check_bathymetry(*bathymetry);
    return 0;
}
