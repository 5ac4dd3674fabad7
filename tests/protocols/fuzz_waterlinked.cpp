// libFuzzer: a byte stream in pieces whose sizes the input chooses. A sentence or a block that is read is
// written back and read as the same again, members of objects lie within them, and memory is bounded.
#include <cstdlib>

#include "protocols/waterlinked/framer.h"
#include "protocols/waterlinked/inspect.h"
#include "protocols/waterlinked/json_text.h"
#include "protocols/waterlinked/pd4.h"
#include "protocols/waterlinked/sentence.h"
#include "tests/protocols/fuzz_stream.h"
#include "tests/protocols/mutator.h"

ECHOLOOP_MUTATOR({.family = "waterlinked", .before = 1})

namespace {
using namespace echoloop::waterlinked;

void check(const Piece& piece) {
    if (piece.kind == Piece::Kind::json) {
        const auto members = members_of(piece.text);
        if (!members) return;
        for (const Member& member : *members)
            if (member.value.empty() || member.value.size() > piece.text.size()) std::abort();
    } else if (piece.kind == Piece::Kind::sentence) {
        const auto sentence = read_sentence(piece.text);
        if (!sentence) std::abort();
        const std::string written = write_sentence(*sentence);
        const auto again = read_sentence(std::string_view(written).substr(0, written.size() - 2));
        if (!again || again->fields != sentence->fields || again->checksum != sentence->checksum)
            std::abort();
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
    echoloop::stream_in_pieces(framer, {data + 1, size - 1}, data[0] + 1U, longest_json, take, " \t\r\n");
    decode({data, size});
    return 0;
}
