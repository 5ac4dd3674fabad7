// libFuzzer: a byte stream in pieces whose sizes the input chooses. What is read is written and read as the
// same again, and all bytes are accounted for.
#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "protocols/altimeter/inspect.h"
#include "protocols/altimeter/line.h"
#include "tests/protocols/fuzz_stream.h"
#include "tests/protocols/mutator.h"

ECHOLOOP_MUTATOR({.family = "altimeter", .before = 1})

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace echoloop::altimeter;
    if (size == 0) return 0;
    Framer framer;
    const auto take = [&](const auto& line) {
        const auto again = read_line(write_line(line));
        if (!again || again->format != line.format) std::abort();
        if (std::abs(again->metres - std::min(line.metres, 999.99)) > 1e-9) std::abort();
    };
    echoloop::stream_in_pieces(framer, {data + 1, size - 1}, data[0] + 1U, 16, take);
    decode({data, size});
    return 0;
}
