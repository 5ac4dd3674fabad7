// libFuzzer: HTTP requests in pieces whose sizes the input chooses. What waits stays bounded.
#include <algorithm>
#include <cstdlib>

#include "protocols/http/request.h"

using namespace echoloop::http;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0) return 0;
    RequestReader reader;
    const std::size_t piece = data[0] + 1U;
    for (std::size_t at = 1; at < size; at += piece) {
        reader.feed({data + at, std::min(piece, size - at)});
        while (reader.next()) {
        }
        if (reader.pending_bytes() > longest_head + longest_body + longest_chunk_line + 4) std::abort();
    }
    return 0;
}
