// libFuzzer: a byte stream in pieces whose sizes the input chooses. What comes out is a message that is
// written back unchanged, all bytes are accounted for, and an image lies within its message.
#include <cstdlib>

#include "protocols/oculus/codec.h"
#include "protocols/oculus/framer.h"
#include "protocols/oculus/inspect.h"
#include "tests/protocols/fuzz_stream.h"
#include "tests/protocols/mutator.h"

using namespace echoloop::oculus;

namespace {

void check_image(const auto& message) {
    if constexpr (requires { image_of(message); }) {
        const auto image = image_of(message);
        if (image && image->bytes.size() != message.ranges * image->row_bytes) std::abort();
    }
}

void check(const Frame& frame) {
    const auto message = parse(frame);
    if (!message) return;
    std::visit([](const auto& m) { check_image(m); }, *message);
    const auto& h = frame.header;
    auto bytes = encode(*message, h.source, h.destination, h.id);
    bytes[8] = static_cast<std::uint8_t>(h.version);  // 0 and 1 are the same
    bytes[14] = static_cast<std::uint8_t>(h.spare), bytes[15] = static_cast<std::uint8_t>(h.spare >> 8);
    if (bytes != encode(frame)) std::abort();
}

}  // namespace

ECHOLOOP_MUTATOR({.family = "oculus", .before = 1})

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0) return 0;
    const std::size_t longest = data[0] % 2 == 0 ? max_payload : host_payload;
    Framer framer(longest);
    const auto take = [&](const auto& frame) {
        check(frame);
        return 16 + frame.payload.size();
    };
    echoloop::stream_in_pieces(framer, {data + 1, size - 1}, data[0] / 2 + 1U, longest + 16, take);
    decode({data, size});
    recognise({data, size});
    return 0;
}
