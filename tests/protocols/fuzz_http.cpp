// libFuzzer: HTTP requests in pieces whose sizes the input chooses, and their bodies as JSON. What waits
// stays bounded.
#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "protocols/http/json.h"
#include "protocols/http/request.h"

using namespace echoloop::http;

namespace {

void check(const std::string& text) {
    const auto json = read_json(text);
    if (!json) return;
    const auto* value = std::get_if<JsonScalar>(&*json);
    if (!value) return;
    if (const auto* number = std::get_if<double>(value))
        if (!std::isfinite(*number) || read_json(json_number(*number)) != json) std::abort();
    if (const auto* words = std::get_if<std::string>(value))
        if (read_json(json_string(*words)) != json) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0) return 0;
    RequestReader reader;
    const std::size_t piece = data[0] + 1U;
    for (std::size_t at = 1; at < size; at += piece) {
        reader.feed({data + at, std::min(piece, size - at)});
        while (const auto next = reader.next())
            if (const auto* request = std::get_if<Request>(&*next)) check(request->body);
        if (reader.pending_bytes() > longest_head + longest_body + longest_chunk_line + 4) std::abort();
    }
    check(std::string(data + 1, data + size));
    return 0;
}
