// libFuzzer: a payload under any id, of an imaging sonar and of a profiler. What parses is written back to
// the same payload.
#include <cstdlib>

#include "protocols/seanet/codec.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace echoloop::seanet;
    if (size == 0) return 0;
    Frame frame;
    frame.header.id = static_cast<Id>(data[0] & 0x7F);
    if (data[0] & 0x80) frame.header.rx_node = frame.header.tx_node = nodes::profiler;
    frame.payload.assign(data + 1, data + size);
    describe(frame);
    const auto message = parse(frame);
    if (!message) {
        if (message.error().what().empty()) std::abort();
        return 0;
    }
    if (make_frame(*message).payload != frame.payload) std::abort();
    return 0;
}
