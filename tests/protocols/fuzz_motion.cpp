// libFuzzer: a byte stream in pieces whose sizes the input chooses. What is read is written and read as the
// same again, and all bytes are accounted for.
#include <algorithm>
#include <cstdlib>

#include "protocols/motion/inspect.h"
#include "protocols/motion/reading.h"
#include "tests/protocols/mutator.h"

ECHOLOOP_MUTATOR({.family = "motion", .before = 1})

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace echoloop::motion;
    if (size == 0) return 0;
    Framer framer;
    const std::size_t piece = data[0] + 1U;
    std::uint64_t framed = 0;
    const auto drain = [&] {
        while (const auto reading = framer.next()) {
            framed += framer.frame_size();
            const auto bytes = write(*reading);
            const auto again = read(bytes);
            if (!again || write(*again) != bytes || bytes.size() != framer.frame_size()) std::abort();
        }
    };
    for (std::size_t at = 1; at < size; at += piece) {
        framer.feed({data + at, std::min(piece, size - at)});
        drain();
        if (framer.pending_bytes() > 27) std::abort();
    }
    framer.finish();
    drain();
    if (framed + framer.skipped_bytes() != size - 1 || framer.pending_bytes() != 0) std::abort();
    decode({data, size});
    return 0;
}
