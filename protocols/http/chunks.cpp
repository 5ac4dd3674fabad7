#include "protocols/http/chunks.h"

#include <algorithm>
#include <charconv>

namespace echoloop::http {

ChunkReader::Progress ChunkReader::take(std::string& buffer, std::string& body) {
    std::size_t at = 0;
    Progress progress = Progress::unfinished;
    while (progress == Progress::unfinished) {
        if (place_ == Place::data) {
            const std::size_t n = std::min(left_, buffer.size() - at);
            body.append(buffer, at, n);
            at += n;
            left_ -= n;
            if (left_ > 0) break;
            place_ = Place::data_end;
        }
        const std::size_t end = buffer.find("\r\n", at);
        if (std::min(end, buffer.size()) - at > longest_chunk_line) return Progress::malformed;
        if (end == std::string::npos) break;
        progress = take_line(std::string_view(buffer).substr(at, end - at), body.size());
        at = end + 2;
    }
    buffer.erase(0, at);
    return progress;
}

ChunkReader::Progress ChunkReader::take_line(std::string_view line, std::size_t have) {
    constexpr std::size_t most_trailers = 32;
    if (place_ == Place::data_end) {
        place_ = Place::size;
        return line.empty() ? Progress::unfinished : Progress::malformed;
    }
    if (place_ == Place::trailer) {
        if (line.empty()) return Progress::whole;
        return ++trailers_ > most_trailers ? Progress::malformed : Progress::unfinished;
    }
    const auto [rest, error] = std::from_chars(line.data(), line.data() + line.size(), left_, 16);
    const std::string_view extension(rest, line.data() + line.size());
    const bool ends =
        extension.empty() || std::string_view("; \t").find(extension.front()) != std::string_view::npos;
    if (error == std::errc::result_out_of_range) return Progress::too_long;
    if (error != std::errc() || !ends) return Progress::malformed;
    if (left_ > limit_ - have) return Progress::too_long;
    place_ = left_ == 0 ? Place::trailer : Place::data;
    return Progress::unfinished;
}

}  // namespace echoloop::http
