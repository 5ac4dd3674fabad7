// libFuzzer: a byte stream in pieces whose sizes the input chooses. What comes out is a frame that is written
// back unchanged, and all bytes are accounted for.
#include <cstdlib>

#include "protocols/ping/codec.h"
#include "protocols/ping/framer.h"
#include "protocols/ping/inspect.h"
#include "tests/protocols/mutator.h"

ECHOLOOP_MUTATOR({.family = "ping", .before = 1})

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace echoloop::ping;
    if (size == 0) return 0;
    Framer framer(data[0] % 2 == 0 ? Framer::Waiting::patient : Framer::Waiting::impatient);
    const std::size_t piece = data[0] / 2 + 1U;
    std::uint64_t framed = 0;
    const auto drain = [&] {
        while (const auto frame = framer.next()) {
            const echoloop::wire::Bytes bytes = encode(*frame);
            if (checksum(bytes) != frame->checksum) std::abort();
            framed += bytes.size();
            const auto message = parse(*frame);
            if (message && is_short_request(*frame)) std::abort();
            if (message && make_frame(*message).payload != frame->payload) std::abort();
        }
    };
    for (std::size_t at = 1; at < size; at += piece) {
        framer.feed({data + at, std::min(piece, size - at)});
        drain();
        if (framer.pending_bytes() > max_frame_bytes) std::abort();
    }
    framer.finish();
    drain();
    if (framed + framer.skipped_bytes() != size - 1 || framer.pending_bytes() != 0) std::abort();
    // Without a checksum in the way: any payload under any id.
    if (size > 3) {
        Frame frame{{static_cast<Id>(data[1] | data[2] << 8), 0, 0}, {data + 3, data + size}, 0};
        const auto message = parse(frame);
        if (message && make_frame(*message).payload != frame.payload) std::abort();
    }
    decode({data, size});
    return 0;
}
