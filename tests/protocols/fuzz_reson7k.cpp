// libFuzzer: a byte stream in pieces whose sizes the input chooses. What comes out is a record that is
// written back unchanged, and all bytes are accounted for.
#include <algorithm>
#include <cstdlib>

#include "protocols/reson7k/codec.h"
#include "protocols/reson7k/framer.h"
#include "protocols/reson7k/inspect.h"
#include "tests/protocols/fuzz_stream.h"
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
    const auto take = [&](const auto& record) { check(record); };
    echoloop::stream_in_pieces(framer, {data + 1, size - 1}, data[0] / 2 + 1U, longest, take);
    decode({data, size});
    recognise({data, size});
    return 0;
}
