// libFuzzer: a byte stream in pieces whose sizes the input chooses. What comes out is a frame, and all bytes
// are accounted for.
#include <cstdlib>

#include "protocols/seanet/codec.h"
#include "protocols/seanet/framer.h"
#include "tests/protocols/fuzz_stream.h"
#include "tests/protocols/mutator.h"

ECHOLOOP_MUTATOR({.family = "seanet", .before = 1})

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace echoloop::seanet;
    if (size == 0) return 0;
    Framer framer(data[0] % 2 == 0 ? Framer::Lengths::trusted : Framer::Lengths::by_id);
    const auto take = [&](const auto& frame) {
        const echoloop::wire::Bytes bytes = encode(frame);
        if (bytes.size() < min_frame_bytes || bytes.size() > max_frame_bytes) std::abort();
        if (const auto message = parse(frame)) make_frame(*message);
        describe(frame);
        return bytes.size();
    };
    echoloop::stream_in_pieces(framer, {data + 1, size - 1}, data[0] / 2 + 1U, max_frame_bytes, take);
    return 0;
}
