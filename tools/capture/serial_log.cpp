#include "tools/capture/serial_log.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string_view>
#include <variant>

namespace echoloop::capture {
namespace {

constexpr std::size_t longest_line = std::size_t{1} << 20, block_of_lines = std::size_t{64} << 10;
constexpr std::string_view blanks = " \t\r";

void skip_blanks(std::string_view& text) {
    text.remove_prefix(std::min(text.size(), text.find_first_not_of(blanks)));
}

int digit(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
}

struct Stretch {
    double time = 0;
    bool by_device = true;
    Bytes bytes;
};

/// Pairs of digits, with or without blanks between them; false for anything else.
bool read_hex(std::string_view text, Bytes& bytes) {
    for (skip_blanks(text); !text.empty(); skip_blanks(text)) {
        if (text.size() < 2 || digit(text[0]) < 0 || digit(text[1]) < 0) return false;
        bytes.push_back(static_cast<std::uint8_t>(digit(text[0]) << 4 | digit(text[1])));
        text.remove_prefix(2);
    }
    return true;
}

/// What a line says, or why it is none; empty for lines that say nothing.
using LogLine = std::variant<std::monostate, Stretch, std::string>;

LogLine parse(std::string_view text) {
    text = text.substr(0, text.find('#'));
    skip_blanks(text);
    if (text.empty()) return std::monostate();
    Stretch stretch;
    const auto [end, error] =
        std::from_chars(text.data(), text.data() + text.size(), stretch.time, std::chars_format::fixed);
    if (error != std::errc{} || !std::isfinite(stretch.time) || stretch.time < 0)
        return std::string("a line begins with a time in seconds, as in '12.345 < 40 30'");
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    if (text.empty() || blanks.find(text.front()) == blanks.npos)
        return std::string("a blank follows the time");
    skip_blanks(text);
    if (!text.empty() && (text.front() == '<' || text.front() == '>')) {
        stretch.by_device = text.front() == '<';
        text.remove_prefix(1);
    }
    if (!read_hex(text, stretch.bytes)) return std::string("bytes are pairs of hexadecimal digits");
    return stretch;
}

}  // namespace

bool SerialLog::recognises(Input& input) {
    const Bytes start = input.peek(block_of_lines);
    std::string_view text(reinterpret_cast<const char*>(start.data()), start.size());
    while (!text.empty()) {
        const auto line = text.substr(0, text.find('\n'));
        const auto said = parse(line);
        if (const auto* stretch = std::get_if<Stretch>(&said)) return !stretch->bytes.empty();
        if (std::holds_alternative<std::string>(said)) return false;
        text.remove_prefix(std::min(text.size(), line.size() + 1));
    }
    return false;
}

std::optional<std::string> SerialLog::line() {
    std::size_t end = text_.find('\n', at_);
    while (end == text_.npos && text_.size() - at_ <= longest_line) {
        text_.erase(0, at_);
        at_ = 0;
        const Bytes more = input_.read(block_of_lines);
        if (more.empty()) break;
        text_.append(more.begin(), more.end());
        end = text_.find('\n');
    }
    if (at_ == text_.size()) return {};
    std::string line = text_.substr(at_, end == text_.npos ? end : end - at_);
    at_ = end == text_.npos ? text_.size() : end + 1;
    ++number_;
    return line;
}

std::optional<CaptureEvent> SerialLog::next() {
    while (counts_.fault.empty()) {
        const auto text = line();
        if (!text) return {};
        LogLine said = parse(*text);
        if (text->size() > longest_line) said = std::string("it is longer than 1 MiB");
        if (const auto* why = std::get_if<std::string>(&said))
            counts_.fault = "line " + std::to_string(number_) + ": " + *why;
        auto* stretch = std::get_if<Stretch>(&said);
        if (stretch == nullptr || stretch->bytes.empty()) continue;
        ++counts_.packets;
        return CaptureEvent{stretch->time, "", stretch->by_device,
                            StreamPiece{"", stretch->by_device, {}, {}, std::move(stretch->bytes)},
                            counts_.packets};
    }
    return {};
}

}  // namespace echoloop::capture
