// libFuzzer: a byte stream in pieces whose sizes the input chooses. What is read is written back and read as
// the same again, and all bytes but line ends are accounted for.
#include <cstdlib>

#include "protocols/nortek/codec.h"
#include "protocols/nortek/inspect.h"
#include "tests/protocols/fuzz_stream.h"
#include "tests/protocols/mutator.h"

ECHOLOOP_MUTATOR({.family = "nortek", .before = 1})

namespace {
using namespace echoloop::nortek;

void check(const Piece& piece) {
    if (piece.kind != Piece::Kind::frame) return;
    const auto frame = parse(piece.bytes);
    if (frame && encode(*frame) != piece.bytes) std::abort();
}
}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0) return 0;
    Framer framer;
    const auto take = [&](const auto& piece) {
        check(piece);
        return piece.size();
    };
    echoloop::stream_in_pieces(framer, {data + 1, size - 1}, data[0] + 1U, header_size + 65535, take, "\r\n");
    decode({data, size});
    return 0;
}
