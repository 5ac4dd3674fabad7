// libFuzzer: a byte stream in pieces whose sizes the input chooses. What is read is written and read as the
// same again, and all bytes are accounted for.
#include <cstdlib>

#include "protocols/motion/inspect.h"
#include "protocols/motion/reading.h"
#include "tests/protocols/fuzz_stream.h"
#include "tests/protocols/mutator.h"

ECHOLOOP_MUTATOR({.family = "motion", .before = 1})

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace echoloop::motion;
    if (size == 0) return 0;
    Framer framer;
    const auto take = [&](const auto& reading) {
        const auto bytes = write(reading);
        const auto again = read(bytes);
        if (!again || write(*again) != bytes || bytes.size() != framer.frame_size()) std::abort();
        return bytes.size();
    };
    echoloop::stream_in_pieces(framer, {data + 1, size - 1}, data[0] + 1U, 27, take);
    decode({data, size});
    return 0;
}
