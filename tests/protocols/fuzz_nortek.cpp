// libFuzzer: a byte stream in pieces whose sizes the input chooses. What is read is written back and read as
// the same again, and all bytes are accounted for.
#include <algorithm>
#include <cstdlib>

#include "protocols/nortek/codec.h"
#include "protocols/nortek/inspect.h"
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
    const std::size_t piece_size = data[0] + 1U;
    const auto drain = [&] {
        while (const auto piece = framer.next()) {
            if (piece->size() != framer.frame_size()) std::abort();
            check(*piece);
        }
    };
    for (std::size_t at = 1; at < size; at += piece_size) {
        framer.feed({data + at, std::min(piece_size, size - at)});
        drain();
        if (framer.pending_bytes() > header_size + 65535) std::abort();
    }
    framer.finish();
    drain();
    if (framer.pending_bytes() != 0) std::abort();
    decode({data, size});
    return 0;
}
