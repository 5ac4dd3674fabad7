// libFuzzer: one datagram or one text, and a file of them. What is read and written back is the same message
// again, and what is divided holds the same bytes.
#include <cstdlib>

#include "protocols/kmall/codec.h"
#include "protocols/kmall/inspect.h"
#include "tests/protocols/mutator.h"

ECHOLOOP_MUTATOR({.family = "kmall"})

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace echoloop::kmall;
    const echoloop::wire::ByteView bytes(data, size);
    std::size_t covered = 0;
    for (const auto& message : decode(bytes)) covered += message.size;
    if (covered != size) std::abort();
    const auto datagram = parse(bytes);
    if (!datagram) {
        if (datagram.error().what().empty()) std::abort();
        return 0;
    }
    const auto back = serialise(*datagram);
    const auto again = parse(back);
    if (!again || serialise(*again) != back) std::abort();
    if (std::holds_alternative<Command>(*datagram)) return 0;
    if (back.size() != size) std::abort();
    for (const auto& part : divided(back))
        if (part.size() > largest_datagram || !parse(part)) std::abort();
    return 0;
}
