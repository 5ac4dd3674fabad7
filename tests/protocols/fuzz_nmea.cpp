// libFuzzer: a byte stream in pieces whose sizes the input chooses. A sentence that is read is written back
// and read as the same again, and all bytes are accounted for.
#include <algorithm>
#include <cstdlib>

#include "protocols/nmea/framer.h"
#include "protocols/nmea/inspect.h"
#include "protocols/nmea/sentence.h"
#include "tests/protocols/mutator.h"

ECHOLOOP_MUTATOR({.family = "nmea", .before = 1})

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace echoloop::nmea;
    if (size == 0) return 0;
    Framer framer;
    const std::size_t piece = data[0] + 1U;
    std::uint64_t framed = 0;
    const auto drain = [&] {
        while (const auto line = framer.next()) {
            framed += framer.frame_size();
            if (line->text.size() > longest_line) std::abort();
            const auto sentence = read_sentence(line->text);
            if (!sentence) continue;
            const std::string written = write_sentence(*sentence);
            const auto again = read_sentence(std::string_view(written).substr(0, written.size() - 2));
            if (!again || again->fields != sentence->fields || again->address != sentence->address)
                std::abort();
            if (again->checksum_fits() != sentence->checksum_fits()) std::abort();
            for (const std::string& field : sentence->fields) read_number(field);
        }
    };
    for (std::size_t at = 1; at < size; at += piece) {
        framer.feed({data + at, std::min(piece, size - at)});
        drain();
        if (framer.pending_bytes() > longest_line + 1) std::abort();
    }
    framer.finish();
    drain();
    if (framed + framer.skipped_bytes() != size - 1 || framer.pending_bytes() != 0) std::abort();
    decode({data, size});
    return 0;
}
