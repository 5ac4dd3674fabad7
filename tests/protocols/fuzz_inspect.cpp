// libFuzzer: any bytes through every family of `echoloop inspect`. The spans it reports cover the input
// without gaps.
#include <cstdlib>

#include "protocols/inspect.h"
#include "tests/protocols/mutator.h"

ECHOLOOP_MUTATOR({})

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace echoloop::inspect;
    const echoloop::wire::ByteView bytes(data, size);
    guess_family(bytes);
    for (const Family& family : families()) {
        std::size_t covered = 0;
        for (const Message& message : family.decode(bytes)) {
            if (message.offset != covered) std::abort();
            covered += message.size;
            for (const Field& field : message.fields) {
                if (field.offset < message.offset || field.offset + field.size > covered) std::abort();
                if (field.text.find('\x1b') != std::string::npos) std::abort();
            }
        }
        if (covered != size) std::abort();
    }
    return 0;
}
