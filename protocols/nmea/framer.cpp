#include "protocols/nmea/framer.h"

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

}  // namespace

wire::Found<Line> LineFinder::find(wire::ByteView bytes, bool finished) const {
    const std::string_view pending = wire::characters(bytes);
    if (!starts_sentence(pending.front())) return {1};
    const std::size_t run = run_of_sentence(pending);
    const std::string_view sentence = pending.substr(0, run), rest = pending.substr(run);
    const auto line = [&](std::size_t size) {
        return wire::Found<Line>{0, size, Line{std::string(sentence)}};
    };
    if (run > longest_line) return {run};
    if (rest.starts_with("\r\n") || rest.starts_with('\n')) {
        if (has_address(sentence)) return line(run + (rest[0] == '\r' ? 2U : 1U));
    } else if (rest.empty() || rest == "\r") {
        if (!finished) return {};
        if (has_address(sentence) && ends_with_checksum(sentence)) return line(pending.size());
    }
    return {run};
}

}  // namespace echoloop::nmea
