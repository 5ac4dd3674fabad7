#include "protocols/motion/reading.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <string_view>

namespace echoloop::motion {
namespace {

constexpr std::size_t tss1_size = 27, em3000_size = 10;
constexpr std::uint8_t first_status = 0x90, last_status = 0xAF, sync = 0x90;
constexpr std::string_view aids = "uUgGhHfF";
constexpr long most_angle = 17999, most_heave = 999, turn = 36000;  // hundredths

bool is_status(std::uint8_t byte) { return byte >= first_status && byte <= last_status; }

long hundredths(double value, long most) { return std::clamp(std::lround(100 * value), -most, most); }

char sign_of(double value, long digits) {
    return std::signbit(value) && (digits != 0 || value == 0) ? '-' : ' ';
}

wire::Bytes write_tss1(const Reading& r) {
    const auto steps = [](double value, double step, long low, long high) {
        return static_cast<unsigned>(std::clamp(std::lround(value / step), low, high)) & 0xFFFFU;
    };
    constexpr long most = 9999;
    const long heave = std::abs(hundredths(r.heave, most)), roll = std::abs(hundredths(r.roll, most)),
               pitch = std::abs(hundredths(r.pitch, most));
    char text[64];
    std::snprintf(text, sizeof text, ":%02X%04X %c%04ld%c%c%04ld %c%04ld\r\n",
                  steps(r.horizontal, horizontal_step, 0, 255),
                  steps(r.vertical, vertical_step, -32768, 32767), sign_of(r.heave, heave), heave,
                  static_cast<char>(r.status), sign_of(r.roll, roll), roll, sign_of(r.pitch, pitch), pitch);
    return {text, text + tss1_size};
}

wire::Bytes write_em3000(const Reading& r) {
    const long heading = ((std::lround(100 * r.heading) % turn) + turn) % turn;
    wire::Bytes bytes{r.status, sync};
    for (const long value : {hundredths(r.roll, most_angle), hundredths(r.pitch, most_angle),
                             hundredths(r.heave, most_heave), heading}) {
        const auto word = static_cast<std::uint16_t>(value);
        bytes.push_back(static_cast<std::uint8_t>(word & 0xFFU));
        bytes.push_back(static_cast<std::uint8_t>(word >> 8U));
    }
    return bytes;
}

/// Digits of the base in capitals and nothing else.
std::optional<unsigned> digits(std::string_view text, int base) {
    constexpr std::string_view all = "0123456789ABCDEF";
    if (text.find_first_not_of(all.substr(0, static_cast<std::size_t>(base))) != text.npos) return {};
    unsigned value = 0;
    std::from_chars(text.data(), text.data() + text.size(), value, base);
    return value;
}

/// A sign and four digits, in hundredths.
std::optional<double> number(std::string_view text) {
    const auto value = digits(text.substr(1), 10);
    if (!value || (text[0] != ' ' && text[0] != '-')) return {};
    return (text[0] == '-' ? -1.0 : 1.0) * static_cast<double>(*value) / 100;
}

std::optional<Reading> read_tss1(std::string_view text) {
    if (text[7] != ' ' || text[19] != ' ' || !text.ends_with("\r\n")) return {};
    const auto horizontal = digits(text.substr(1, 2), 16), vertical = digits(text.substr(3, 4), 16);
    const auto heave = number(text.substr(8, 5)), roll = number(text.substr(14, 5)),
               pitch = number(text.substr(20, 5));
    if (!horizontal || !vertical || !heave || !roll || !pitch || aids.find(text[13]) == aids.npos) return {};
    Reading r;
    r.horizontal = *horizontal * horizontal_step;
    r.vertical = static_cast<std::int16_t>(*vertical) * vertical_step;
    r.heave = *heave, r.roll = *roll, r.pitch = *pitch;
    r.status = static_cast<std::uint8_t>(text[13]);
    return r;
}

std::optional<Reading> read_em3000(wire::ByteView bytes) {
    if (!is_status(bytes[0]) || bytes[1] != sync) return {};
    const auto word = [&](std::size_t at) {
        return static_cast<std::uint16_t>(bytes[at] | unsigned{bytes[at + 1]} << 8U);
    };
    const auto angle = [&](std::size_t at) { return static_cast<std::int16_t>(word(at)); };
    Reading r{.format = Format::em3000,
              .roll = angle(2) / 100.0,
              .pitch = angle(4) / 100.0,
              .heave = angle(6) / 100.0,
              .heading = word(8) / 100.0,
              .status = bytes[0]};
    const bool valid = std::abs(angle(2)) <= most_angle && std::abs(angle(4)) <= most_angle &&
                       std::abs(angle(6)) <= most_heave && word(8) < turn;
    return valid ? std::optional(r) : std::nullopt;
}

/// Whether another message may stand at `at`, as far as there are bytes.
bool may_begin(wire::ByteView bytes, std::size_t at) {
    if (at >= bytes.size() || bytes[at] == ':') return true;
    return is_status(bytes[at]) && (at + 1 >= bytes.size() || bytes[at + 1] == sync);
}

}  // namespace

wire::Bytes write(const Reading& reading) {
    return reading.format == Format::tss1 ? write_tss1(reading) : write_em3000(reading);
}

std::optional<Reading> read(wire::ByteView bytes) {
    if (bytes.size() == tss1_size && bytes[0] == ':') return read_tss1(wire::characters(bytes));
    if (bytes.size() == em3000_size) return read_em3000(bytes);
    return {};
}

wire::Found<Reading> Finder::find(wire::ByteView pending, bool finished) const {
    const bool line = pending[0] == ':';
    const std::size_t size = line ? tss1_size : em3000_size;
    if (!line && (!is_status(pending[0]) || !may_begin(pending, 0))) {
        const auto begins = [](std::uint8_t byte) { return byte == ':' || is_status(byte); };
        const auto next = std::find_if(pending.begin() + 1, pending.end(), begins);
        return {static_cast<std::size_t>(next - pending.begin())};
    }
    if (pending.size() < size) return finished ? wire::Found<Reading>{1} : wire::Found<Reading>{};
    const auto reading = read(pending.first(size));
    if (!reading || (!line && !may_begin(pending, size))) return {1};
    return {0, size, reading};
}

}  // namespace echoloop::motion
