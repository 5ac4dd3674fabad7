// libFuzzer: bytes as a datagram and as a .83P file. What parses is written back unchanged; inspecting
// accounts for every byte.
#include <cstdlib>

#include "protocols/imagenex/delta_t_codec.h"
#include "protocols/imagenex/delta_t_inspect.h"
#include "tests/protocols/mutator.h"

ECHOLOOP_MUTATOR({.family = "deltat"})

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace echoloop::imagenex;
    const echoloop::wire::ByteView bytes(data, size);
    const auto message = parse_delta_t(bytes);
    if (message) {
        const auto back = encode(*message);
        if (!std::equal(back.begin(), back.end(), data, data + size)) std::abort();
        if (delta_t_bytes(bytes) != size) std::abort();
        const auto* profile = std::get_if<Profile83P>(&*message);
        if (profile != nullptr && encode_with_little_floats(*profile).size() != size) std::abort();
    }
    std::size_t covered = 0;
    for (const auto& one : decode_delta_t(bytes)) {
        if (one.offset != covered) std::abort();
        covered += one.size;
    }
    if (covered != size) std::abort();
    recognise_delta_t(bytes);
    return 0;
}
