// libFuzzer: a byte stream in pieces whose sizes the input chooses. What comes out is a frame that is written
// back unchanged, and all bytes are accounted for.
#include <cstdlib>

#include "protocols/ping/codec.h"
#include "protocols/ping/framer.h"
#include "protocols/ping/inspect.h"
#include "tests/protocols/fuzz_stream.h"
#include "tests/protocols/mutator.h"

ECHOLOOP_MUTATOR({.family = "ping", .before = 1})

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace echoloop::ping;
    if (size == 0) return 0;
    Framer framer(data[0] % 2 == 0 ? Framer::Waiting::patient : Framer::Waiting::impatient);
    const auto take = [&](const auto& frame) {
        const echoloop::wire::Bytes bytes = encode(frame);
        if (checksum(bytes) != frame.checksum) std::abort();
        const auto message = parse(frame);
        if (message && is_short_request(frame)) std::abort();
        if (message && make_frame(*message).payload != frame.payload) std::abort();
        return bytes.size();
    };
    echoloop::stream_in_pieces(framer, {data + 1, size - 1}, data[0] / 2 + 1U, max_frame_bytes, take);
    // Without a checksum in the way: any payload under any id.
    if (size > 3) {
        Frame frame{{static_cast<Id>(data[1] | data[2] << 8), 0, 0}, {data + 3, data + size}, 0};
        const auto message = parse(frame);
        if (message && make_frame(*message).payload != frame.payload) std::abort();
    }
    decode({data, size});
    return 0;
}
