// libFuzzer: a byte stream in pieces whose sizes the input chooses. A sentence that is read is written back
// and read as the same again, and all bytes are accounted for.
#include <cstdlib>

#include "protocols/nmea/framer.h"
#include "protocols/nmea/inspect.h"
#include "protocols/nmea/sentence.h"
#include "tests/protocols/fuzz_stream.h"
#include "tests/protocols/mutator.h"

ECHOLOOP_MUTATOR({.family = "nmea", .before = 1})

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace echoloop::nmea;
    if (size == 0) return 0;
    Framer framer;
    const auto take = [&](const auto& line) {
        if (line.text.size() > longest_line) std::abort();
        const auto sentence = read_sentence(line.text);
        if (!sentence) return;
        const std::string written = write_sentence(*sentence);
        const auto again = read_sentence(std::string_view(written).substr(0, written.size() - 2));
        if (!again || again->fields != sentence->fields || again->address != sentence->address) std::abort();
        if (again->checksum_fits() != sentence->checksum_fits()) std::abort();
        for (const std::string& field : sentence->fields) read_number(field);
    };
    echoloop::stream_in_pieces(framer, {data + 1, size - 1}, data[0] + 1U, longest_line + 1, take);
    decode({data, size});
    return 0;
}
