// libFuzzer: a byte stream in pieces whose sizes the input chooses. What is read is written back and read as
// the same again, and all bytes but line ends are accounted for.
#include <cstdlib>

#include "protocols/teledyne/codec.h"
#include "protocols/teledyne/inspect.h"
#include "tests/protocols/fuzz_stream.h"
#include "tests/protocols/mutator.h"

ECHOLOOP_MUTATOR({.family = "teledyne", .before = 1})

namespace {
using namespace echoloop::teledyne;

void check(const Piece& piece) {
    if (piece.kind == Piece::Kind::ensemble) {
        const auto ensemble = parse_ensemble(piece.bytes);
        if (!ensemble) return;
        const auto again = parse_ensemble(encode(*ensemble));
        if (!again || *again != *ensemble) std::abort();
    } else if (piece.kind == Piece::Kind::pd5) {
        const auto block = parse_pd5(piece.bytes);
        if (!block || encode(*block) != piece.bytes) std::abort();
    }
}
}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0) return 0;
    Framer framer;
    const auto take = [&](const auto& piece) {
        check(piece);
        return piece.size();
    };
    echoloop::stream_in_pieces(framer, {data + 1, size - 1}, data[0] + 1U, longest_ensemble + 2, take,
                               "\r\n");
    decode({data, size});
    return 0;
}
