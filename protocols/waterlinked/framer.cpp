#include "protocols/waterlinked/framer.h"

#include "protocols/waterlinked/json_text.h"
#include "protocols/waterlinked/pd4.h"
#include "protocols/waterlinked/sentence.h"

namespace echoloop::waterlinked {
namespace {

using Found = wire::Found<Piece>;

constexpr std::string_view blanks = " \t\r\n", starts = "{[w:}";  // '}' is 7D, the first byte of PD4
constexpr std::string_view pd4_head("}\0\x2d\0", 4);

/// Skips to where something may begin.
Found noise(std::string_view pending) {
    std::size_t at = 1;
    while (at < pending.size() && starts.find(pending[at]) == std::string_view::npos) ++at;
    return {at};
}

std::string line_end_of(std::string_view rest) {
    if (rest.starts_with("\r\n")) return "\r\n";
    return rest.starts_with('\r') || rest.starts_with('\n') ? std::string(1, rest[0]) : "";
}

Found piece(Piece::Kind kind, std::string_view text, std::string line_end) {
    const std::size_t size = text.size() + line_end.size();
    return {0, size, Piece{kind, std::string(text), std::move(line_end)}};
}

Found find_json(std::string_view pending, bool finished) {
    const std::size_t size = json_size(pending.substr(0, longest_json));
    if (size == 0) return finished || pending.size() >= longest_json ? noise(pending) : Found{};
    return piece(Piece::Kind::json, pending.substr(0, size), line_end_of(pending.substr(size)));
}

bool begins_pd6(std::string_view text) {
    const auto capital = [&](std::size_t at) { return text[at] >= 'A' && text[at] <= 'Z'; };
    return text.size() > 3 && text[0] == ':' && capital(1) && capital(2) && text[3] == ',';
}

Found find_line(std::string_view pending, bool finished) {
    std::size_t run = 1;
    while (run < pending.size() && pending[run] >= ' ' && pending[run] <= '~') ++run;
    const std::string_view text = pending.substr(0, run);
    if (run > longest_line) return noise(pending);
    const bool ended = run < pending.size() && line_end_of(pending.substr(run)).size() > 0;
    if (run == pending.size() && !finished) return {};
    const bool pd6 = begins_pd6(text);
    const auto sentence = pd6 ? std::nullopt : read_sentence(text);
    if ((pd6 && ended) || (sentence && (ended || sentence->checksum)))
        return piece(pd6 ? Piece::Kind::pd6 : Piece::Kind::sentence, text, line_end_of(pending.substr(run)));
    return noise(pending);
}

Found find_pd4(std::string_view pending, bool finished) {
    if (!pd4_head.starts_with(pending.substr(0, pd4_head.size()))) return noise(pending);
    if (pending.size() < pd4_size) return finished ? noise(pending) : Found{};
    return piece(Piece::Kind::pd4, pending.substr(0, pd4_size), "");
}

}  // namespace

wire::Found<Piece> PieceFinder::find(wire::ByteView bytes, bool finished) const {
    const std::string_view pending = wire::characters(bytes);
    const char first = pending.front();
    if (blanks.find(first) != std::string_view::npos) return {0, 1};
    if (first == '{' || first == '[') return find_json(pending, finished);
    if (first == 'w' || first == ':') return find_line(pending, finished);
    return first == '}' ? find_pd4(pending, finished) : noise(pending);
}

}  // namespace echoloop::waterlinked
