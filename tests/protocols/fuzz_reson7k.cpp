// libFuzzer: a byte stream in pieces whose sizes the input chooses. What comes out is a record that is
// written back unchanged, and all bytes are accounted for.
#include <algorithm>
#include <cstdlib>

#include "protocols/reson7k/codec.h"
#include "protocols/reson7k/framer.h"
#include "protocols/reson7k/inspect.h"
#include "tests/protocols/mutator.h"

using namespace echoloop::reson7k;

namespace {

void check(const Record& record) {
    const auto bytes = encode(record);
    const auto again = read_record(bytes);
    if (!again || again->content != record.content) std::abort();
    const auto message = parse(record);
    if (message && encode(*message, record.frame) != bytes) std::abort();
}

}  // namespace

ECHOLOOP_MUTATOR({.family = "reson7k", .before = 1})

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0) return 0;
    const std::size_t longest = data[0] % 2 == 0 ? max_record : host_record;
    Framer framer(longest, data[0] % 4 < 2 ? Source::network : Source::network_or_file);
    const std::size_t piece = data[0] / 2 + 1U;
    std::uint64_t framed = 0;
    const auto drain = [&] {
        while (const auto record = framer.next()) {
            framed += framer.frame_size();
            check(*record);
        }
    };
    for (std::size_t at = 1; at < size; at += piece) {
        framer.feed({data + at, std::min(piece, size - at)});
        drain();
    }
    framer.finish();
    drain();
    if (framed + framer.skipped_bytes() != size - 1 || framer.pending_bytes() != 0) std::abort();
    decode({data, size});
    recognise({data, size});
    return 0;
}
