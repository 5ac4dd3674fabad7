#include "protocols/nmea/framer.h"

#include <algorithm>
#include <string_view>

namespace echoloop::nmea {
namespace {

constexpr std::size_t shortest_address = 3;

bool starts_sentence(char c) { return c == '$' || c == '!'; }
bool printable(char c) { return c >= ' ' && c <= '~'; }
bool in_address(char c) { return (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9'); }
bool hex_digit(char c) { return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'F') || (c >= 'a' && c <= 'f'); }

/// Characters of a sentence from its first on, before the line's end or whatever else cannot be in one.
std::size_t run_of_sentence(std::string_view text) {
    std::size_t at = 1;
    while (at < text.size() && printable(text[at]) && !starts_sentence(text[at])) ++at;
    return at;
}

bool has_address(std::string_view sentence) {
    std::size_t end = 1;
    while (end < sentence.size() && in_address(sentence[end])) ++end;
    return end > shortest_address && (end == sentence.size() || sentence[end] == ',' || sentence[end] == '*');
}

bool ends_with_checksum(std::string_view sentence) {
    const std::size_t n = sentence.size();
    return n > 3 && sentence[n - 3] == '*' && hex_digit(sentence[n - 2]) && hex_digit(sentence[n - 1]);
}

/// What stands where a sentence may begin.
struct Look {
    std::size_t text = 0;  ///< characters of the sentence; 0: none begins here
    std::size_t size = 0;  ///< bytes of the line, or those to skip; 0: more must come first
};

Look look(std::string_view pending, bool finished) {
    if (!starts_sentence(pending.front())) return {0, 1};
    const std::size_t run = run_of_sentence(pending);
    const std::string_view sentence = pending.substr(0, run), rest = pending.substr(run);
    if (run > longest_line) return {0, run};
    if (rest.starts_with("\r\n") || rest.starts_with('\n'))
        return has_address(sentence) ? Look{run, run + (rest[0] == '\r' ? 2U : 1U)} : Look{0, run};
    if (rest.empty() || rest == "\r") {
        if (!finished) return {};
        if (has_address(sentence) && ends_with_checksum(sentence)) return {run, pending.size()};
    }
    return {0, run};
}

}  // namespace

void Framer::feed(wire::ByteView bytes) {
    finished_ = false;
    buffer_.erase(0, begin_);
    begin_ = 0;
    buffer_.append(bytes.begin(), bytes.end());
}

void Framer::skip(std::size_t count) {
    begin_ += count;
    position_ += count;
    skipped_ += count;
}

std::optional<Line> Framer::next() {
    while (pending_bytes() > 0) {
        const std::string_view pending = std::string_view(buffer_).substr(begin_);
        const Look found = look(pending, finished_);
        if (found.size == 0) return std::nullopt;
        if (found.text == 0) {
            skip(found.size);
            continue;
        }
        Line line{std::string(pending.substr(0, found.text)), found.size};
        frame_offset_ = position_;
        begin_ += found.size;
        position_ += found.size;
        return line;
    }
    return std::nullopt;
}

}  // namespace echoloop::nmea
