// libFuzzer: a byte stream in pieces whose sizes the input chooses. What comes out is a frame, and all bytes
// are accounted for.
#include <cstdlib>

#include "protocols/seanet/codec.h"
#include "protocols/seanet/framer.h"
#include "tests/protocols/mutator.h"

ECHOLOOP_MUTATOR({.family = "seanet", .before = 1})

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace echoloop::seanet;
    if (size == 0) return 0;
    Framer framer(data[0] % 2 == 0 ? Framer::Lengths::trusted : Framer::Lengths::by_id);
    const std::size_t piece = data[0] / 2 + 1U;
    std::uint64_t framed = 0;
    const auto drain = [&] {
        while (const auto frame = framer.next()) {
            const echoloop::wire::Bytes bytes = encode(*frame);
            if (bytes.size() < min_frame_bytes || bytes.size() > max_frame_bytes) std::abort();
            framed += bytes.size();
            if (const auto message = parse(*frame)) make_frame(*message);
            describe(*frame);
        }
    };
    for (std::size_t at = 1; at < size; at += piece) {
        framer.feed({data + at, std::min(piece, size - at)});
        drain();
        if (framer.pending_bytes() > max_frame_bytes) std::abort();
    }
    framer.finish();
    drain();
    if (framed + framer.skipped_bytes() + framer.pending_bytes() != size - 1) std::abort();
    if (framer.pending_bytes() != 0) std::abort();
    return 0;
}
