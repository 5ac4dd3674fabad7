// libFuzzer: a byte stream in pieces whose sizes the input chooses. Every frame that comes out has a right
// checksum behind it and can be parsed.
#include <algorithm>
#include <cstdlib>

#include "protocols/mavlink/codec.h"
#include "protocols/mavlink/framer.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0) return 0;
    echoloop::mavlink::Framer framer;
    const std::size_t piece = data[0] + 1U;
    for (std::size_t at = 1; at < size; at += piece) {
        framer.feed({data + at, std::min(piece, size - at)});
        while (const auto frame = framer.next())
            if (!echoloop::mavlink::parse(*frame)) std::abort();
    }
    return 0;
}
