#include "protocols/altimeter/line.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>

namespace echoloop::altimeter {
namespace {

constexpr double most = 999.99;              // m
constexpr std::size_t longest = 10;          // "xxx.xxxm" CR LF
constexpr std::size_t digits_before = 3;     // the point
constexpr std::size_t most_millimetres = 6;  // digits

bool digit(char c) { return c >= '0' && c <= '9'; }
bool all_digits(std::string_view text) {
    return !text.empty() && std::all_of(text.begin(), text.end(), digit);
}

std::optional<double> metres_of(std::string_view number, std::size_t decimals) {
    if (number.size() != digits_before + 1 + decimals || number[digits_before] != '.') return std::nullopt;
    if (!all_digits(number.substr(0, digits_before)) || !all_digits(number.substr(digits_before + 1)))
        return std::nullopt;
    double value = 0;
    std::from_chars(number.data(), number.data() + number.size(), value, std::chars_format::fixed);
    return value;
}

std::optional<double> millimetres_of(std::string_view number) {
    if (number.size() > most_millimetres || !all_digits(number)) return std::nullopt;
    long value = 0;
    std::from_chars(number.data(), number.data() + number.size(), value);
    return static_cast<double>(value) / 1000;
}

/// What `text`, which has a line end, ends with: a line behind bytes that are none, or those only.
wire::Found<Reading> line_at_end(std::string_view text) {
    for (std::size_t size = std::min(text.size(), longest); size > 0; --size) {
        const std::size_t from = text.size() - size;
        if (from > 0 && (digit(text[from - 1]) || text[from - 1] == '.')) continue;
        if (const auto reading = read_line(text.substr(from))) return {from, size, reading};
    }
    return {text.size()};
}

}  // namespace

std::string write_line(const Reading& reading) {
    const double metres = std::clamp(reading.metres, 0.0, most);
    char text[32];
    switch (reading.format) {
        case Format::two_decimals:
            std::snprintf(text, sizeof text, "%06.2fm\r\n", metres);
            break;
        case Format::millimetres:
            std::snprintf(text, sizeof text, "%ldmm\n", std::lround(1000 * metres));
            break;
        case Format::three_decimals:
            std::snprintf(text, sizeof text, "%07.3fm\r\n", metres);
            break;
    }
    return text;
}

std::optional<Reading> read_line(std::string_view line) {
    const auto before = [&](std::string_view end) { return line.substr(0, line.size() - end.size()); };
    if (line.ends_with("mm\n")) {
        if (const auto metres = millimetres_of(before("mm\n"))) return Reading{Format::millimetres, *metres};
    } else if (line.ends_with("m\r\n")) {
        if (const auto metres = metres_of(before("m\r\n"), 3))
            return Reading{Format::three_decimals, *metres};
        if (const auto metres = metres_of(before("m\r\n"), 2)) return Reading{Format::two_decimals, *metres};
    }
    return std::nullopt;
}

wire::Found<Reading> LineFinder::find(wire::ByteView bytes, bool finished) const {
    const std::string_view pending = wire::characters(bytes);
    const std::size_t end = pending.find('\n');
    if (end != std::string_view::npos) return line_at_end(pending.substr(0, end + 1));
    // One more than a line, for what stands before it matters.
    const std::size_t kept = finished ? 0 : longest + 1;
    return {pending.size() - std::min(pending.size(), kept)};
}

}  // namespace echoloop::altimeter
