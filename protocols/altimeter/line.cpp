#include "protocols/altimeter/line.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>

namespace echoloop::altimeter {
namespace {

constexpr double most = 999.99;       // m
constexpr std::size_t longest = 11;   // "Axxx.xxxm" CR LF
constexpr std::size_t time_size = 4;  // bytes
constexpr std::size_t most_millimetres = 6, centimetre_digits = 5;

bool digit(char c) { return c >= '0' && c <= '9'; }
bool all_digits(std::string_view text) {
    return !text.empty() && std::all_of(text.begin(), text.end(), digit);
}

/// With a point and so many digits before and behind it.
std::optional<double> metres_of(std::string_view number, std::size_t digits, std::size_t decimals) {
    if (number.size() != digits + 1 + decimals || number[digits] != '.') return std::nullopt;
    if (!all_digits(number.substr(0, digits)) || !all_digits(number.substr(digits + 1))) return std::nullopt;
    double value = 0;
    std::from_chars(number.data(), number.data() + number.size(), value, std::chars_format::fixed);
    return value;
}

std::optional<double> whole(std::string_view number, std::size_t most_digits) {
    if (number.size() > most_digits || !all_digits(number)) return std::nullopt;
    long value = 0;
    std::from_chars(number.data(), number.data() + number.size(), value);
    return static_cast<double>(value);
}

std::optional<Reading> reading(Format format, std::optional<double> metres) {
    return metres ? std::optional(Reading{.format = format, .metres = *metres}) : std::nullopt;
}

/// What stands before "m" CR LF.
std::optional<Reading> read_tritech(std::string_view number) {
    char letter = 0;
    if (!number.empty() && number[0] >= 'A' && number[0] <= 'H') {
        letter = number[0];
        number.remove_prefix(1);
    }
    if (const auto metres = metres_of(number, 3, 3))
        return Reading{.format = Format::three_decimals, .metres = *metres, .letter = letter};
    if (letter != 0) return std::nullopt;
    if (const auto metres = metres_of(number, 3, 2)) return reading(Format::two_decimals, metres);
    return reading(Format::two_digits, metres_of(number, 2, 3));
}

/// What stands between R and CR LF.
std::optional<Reading> read_benthos(std::string_view text) {
    const char mark = text.ends_with('E') || text.ends_with('<') ? text.back() : '\0';
    if (mark != 0) text.remove_suffix(1);
    auto found = reading(Format::benthos, metres_of(text, 2, 2));
    if (found) found->mark = mark;
    return found;
}

/// What stands before CR LF and nothing else.
std::optional<Reading> read_plain(std::string_view number) {
    if (number.size() == centimetre_digits && all_digits(number))
        return reading(Format::centimetres, *whole(number, centimetre_digits) / 100);
    for (std::size_t digits = 1; digits <= 3; ++digits)
        if (const auto metres = metres_of(number, digits, 3)) return reading(Format::metres, metres);
    return std::nullopt;
}

std::optional<Reading> read_time(std::string_view bytes) {
    if (bytes.size() != time_size || bytes[0] != '\xFF') return std::nullopt;
    const auto byte = [&](std::size_t at) { return static_cast<std::uint8_t>(bytes[at]); };
    return Reading{.format = Format::time,
                   .microseconds = static_cast<std::uint16_t>(byte(1) << 8 | byte(2)),
                   .level = byte(3)};
}

/// What `text`, which has a line end, ends with: a line behind bytes that are none, or those only.
wire::Found<Reading> line_at_end(std::string_view text) {
    for (std::size_t size = std::min(text.size(), longest); size > 0; --size) {
        const std::size_t from = text.size() - size;
        if (from > 0 && (digit(text[from - 1]) || text[from - 1] == '.')) continue;
        const auto reading = read_line(text.substr(from));
        if (reading && (from == 0 || is_sure(reading->format))) return {from, size, reading};
    }
    return {text.size()};
}

}  // namespace

std::string write_line(const Reading& reading) {
    const double metres = std::clamp(reading.metres, 0.0, most), two = std::min(metres, 99.999);
    char text[32] = "";
    switch (reading.format) {
        case Format::two_decimals:
            std::snprintf(text, sizeof text, "%06.2fm\r\n", metres);
            break;
        case Format::millimetres:
            std::snprintf(text, sizeof text, "%ldmm\n", std::lround(1000 * metres));
            break;
        case Format::three_decimals:
            std::snprintf(text, sizeof text, "%.1s%07.3fm\r\n", &reading.letter, metres);
            break;
        case Format::two_digits:
            std::snprintf(text, sizeof text, "%06.3fm\r\n", two);
            break;
        case Format::benthos:
            std::snprintf(text, sizeof text, "R%05.2f%.1s\r\n", std::min(two, 99.99), &reading.mark);
            break;
        case Format::metres:
            std::snprintf(text, sizeof text, "%.3f\r\n", metres);
            break;
        case Format::centimetres:
            std::snprintf(text, sizeof text, "%05ld\r\n", std::lround(100 * metres));
            break;
        case Format::time: {
            const auto part = [](unsigned value) { return static_cast<char>(value & 0xFF); };
            const std::uint16_t time = reading.microseconds;
            return {'\xFF', part(unsigned{time} >> 8), part(time), part(reading.level)};
        }
    }
    return text;
}

std::optional<Reading> read_line(std::string_view line) {
    const auto before = [&](std::string_view end) { return line.substr(0, line.size() - end.size()); };
    if (const auto time = read_time(line)) return time;
    if (line.ends_with("mm\n")) {
        const auto number = whole(before("mm\n"), most_millimetres);
        return number ? reading(Format::millimetres, *number / 1000) : std::nullopt;
    }
    if (line.ends_with("m\r\n")) return read_tritech(before("m\r\n"));
    if (!line.ends_with("\r\n")) return std::nullopt;
    return line.starts_with('R') ? read_benthos(before("\r\n").substr(1)) : read_plain(before("\r\n"));
}

bool is_sure(Format format) {
    return format != Format::metres && format != Format::centimetres && format != Format::time;
}

wire::Found<Reading> LineFinder::find(wire::ByteView bytes, bool finished) const {
    const std::string_view pending = wire::characters(bytes);
    if (pending.starts_with('\xFF') && pending.size() <= time_size && !finished) return {};
    if (pending.starts_with('\xFF') && pending.size() >= time_size) {
        const bool another = pending.size() == time_size || pending[time_size] == '\xFF';
        if (another) return {0, time_size, read_time(pending.substr(0, time_size))};
    }
    const std::size_t end = pending.find('\n');
    if (end != std::string_view::npos) return line_at_end(pending.substr(0, end + 1));
    // One more than a line, for what stands before it matters.
    const std::size_t kept = finished ? 0 : longest + 1;
    return {pending.size() - std::min(pending.size(), kept)};
}

}  // namespace echoloop::altimeter
