// libFuzzer: a byte stream in pieces whose sizes the input chooses. What is read is written back unchanged,
// and all bytes are accounted for.
#include <algorithm>
#include <cstdlib>

#include "protocols/edgetech/codec.h"
#include "protocols/edgetech/inspect.h"
#include "tests/protocols/mutator.h"

ECHOLOOP_MUTATOR({.family = "edgetech", .before = 1})

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace echoloop::edgetech;
    if (size == 0) return 0;
    Framer framer;
    const std::size_t piece = data[0] + 1U;
    std::uint64_t framed = 0;
    const auto drain = [&] {
        while (const auto frame = framer.next()) {
            framed += frame->size();
            const auto message = parse(*frame);
            if (message && encode(*message) != *frame) std::abort();
        }
    };
    for (std::size_t at = 1; at < size; at += piece) {
        framer.feed({data + at, std::min(piece, size - at)});
        drain();
    }
    framer.finish();
    drain();
    if (framed + framer.skipped_bytes() != size - 1 || framer.pending_bytes() != 0) std::abort();
    decode({data, size});
    return 0;
}
