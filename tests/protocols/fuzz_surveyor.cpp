// libFuzzer: any payload under any id, and any byte stream. What a Surveyor's codec reads, it writes back
// unchanged; a message is either read or asked for, never both.
#include <algorithm>
#include <cstdlib>

#include "protocols/cerulean/inspect.h"
#include "protocols/cerulean/surveyor_codec.h"
#include "protocols/ping/codec.h"
#include "protocols/ping/framer.h"
#include "tests/protocols/mutator.h"

namespace {

void check(const echoloop::ping::Frame& frame) {
    namespace surveyor = echoloop::cerulean::surveyor;
    const auto message = surveyor::Codec::parse(frame);
    if (!message) return;
    if (surveyor::Codec::is_short_request(frame)) std::abort();
    const auto written = surveyor::Codec::encode(*message, frame.header.source, frame.header.destination);
    if (written.size() != frame.payload.size() + echoloop::ping::min_frame_bytes) std::abort();
    if (!std::equal(frame.payload.begin(), frame.payload.end(), written.begin() + 8)) std::abort();
}

}  // namespace

ECHOLOOP_MUTATOR({.family = "cerulean"})

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size < 2) return 0;
    check({{static_cast<echoloop::ping::Id>(data[0] | data[1] << 8), 1, 0}, {data + 2, data + size}, 0});
    echoloop::ping::Framer framer(echoloop::ping::Framer::Waiting::impatient);
    framer.feed({data, size});
    while (const auto frame = framer.next()) check(*frame);
    echoloop::cerulean::decode({data, size});
    return 0;
}
