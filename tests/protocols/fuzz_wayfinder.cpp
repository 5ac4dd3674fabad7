// libFuzzer: a byte stream in pieces whose sizes the input chooses. What is read is written back unchanged,
// and all bytes are accounted for.
#include <cstdlib>

#include "protocols/wayfinder/codec.h"
#include "protocols/wayfinder/inspect.h"
#include "tests/protocols/fuzz_stream.h"
#include "tests/protocols/mutator.h"

ECHOLOOP_MUTATOR({.family = "wayfinder", .before = 1})

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace echoloop::wayfinder;
    if (size == 0) return 0;
    Framer framer;
    const auto take = [](const auto& bytes) {
        const auto packet = parse(bytes);
        if (packet && encode(*packet) != bytes) std::abort();
        return bytes.size();
    };
    echoloop::stream_in_pieces(framer, {data + 1, size - 1}, data[0] + 1U, longest_packet, take);
    decode({data, size});
    return 0;
}
