// libFuzzer: a stream in pieces whose sizes the input chooses, and the same bytes as datagrams. What is
// understood is written back to something that reads the same, and all bytes are accounted for.
#include <cstdlib>

#include "protocols/aris/framer.h"
#include "protocols/aris/inspect.h"
#include "tests/protocols/fuzz_stream.h"
#include "tests/protocols/mutator.h"

using namespace echoloop::aris;

namespace {

/// NaN is not equal to itself; what is written of it is.
template <class M, class Parse>
void check(const std::optional<M>& message, const Parse& parse) {
    if (!message) return;
    const auto bytes = encode(*message);
    const auto again = parse(bytes);
    if (!again || encode(*again) != bytes) std::abort();
}

void check_datagram(echoloop::wire::ByteView bytes) {
    check(parse_availability(bytes), parse_availability);
    check(parse_frame_part(bytes), parse_frame_part);
    check(parse_frame_part_ack(bytes), parse_frame_part_ack);
    check(parse_frame_header(bytes), parse_frame_header);
}

}  // namespace

ECHOLOOP_MUTATOR({.family = "aris", .before = 1})

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0) return 0;
    Framer framer;
    const auto take = [&](const auto& frame) {
        check(std::optional(frame), [](const echoloop::wire::Bytes& bytes) {
            return parse_command(echoloop::wire::ByteView(bytes).subspan(length_bytes));
        });
    };
    echoloop::stream_in_pieces(framer, {data + 1, size - 1}, data[0] + 1U, longest_command + length_bytes,
                               take);
    check_datagram({data + 1, size - 1});
    decode({data, size});
    recognise({data, size});
    return 0;
}
