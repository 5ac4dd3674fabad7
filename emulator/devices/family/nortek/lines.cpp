#include "emulator/devices/family/nortek/lines.h"

#include <array>
#include <charconv>
#include <chrono>
#include <cmath>
#include <cstdio>

#include "emulator/devices/family/doppler/moment.h"
#include "protocols/nmea/sentences.h"

namespace echoloop::nortek_console {
namespace {

std::vector<std::string> split(std::string_view text) {
    std::vector<std::string> parts{""};
    bool quoted = false;
    for (const char c : text) {
        quoted = quoted != (c == '"');
        if (c == ',' && !quoted)
            parts.emplace_back();
        else
            parts.back() += c;
    }
    return parts;
}

}  // namespace

Words read_words(std::string_view line) {
    Words out;
    out.sentence = line.starts_with("$PNOR,");
    if (out.sentence) {
        const std::string_view body = line.substr(1, std::min(line.rfind('*'), line.size()) - 1);
        out.sound = nmea::sentence(body) == std::string(line) + "\r\n";
        line = body.substr(5);
    }
    std::string upper(line);
    bool quoted = false;
    for (char& c : upper) {
        quoted = quoted != (c == '"');
        if (!quoted && c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
    }
    out.all = split(upper);
    return out;
}

std::string ended(const std::string& line, bool sentence) {
    return sentence ? nmea::sentence("PNOR," + line) : line + "\r\n";
}

std::optional<double> number_in(std::string_view text) {
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool whole = error == std::errc() && end == text.data() + text.size() && !text.empty();
    return whole && std::isfinite(value) ? std::optional(value) : std::nullopt;
}

std::optional<std::int64_t> clock_of(int year, int month, int day, int hour, int minute, int second) {
    namespace chrono = std::chrono;
    const chrono::year_month_day date{chrono::year(year), chrono::month(static_cast<unsigned>(month)),
                                      chrono::day(static_cast<unsigned>(day))};
    if (!date.ok() || year < 1970 || hour < 0 || hour > 23 || minute < 0 || minute > 59 || second < 0 ||
        second > 59)
        return std::nullopt;
    const auto at =
        chrono::sys_days(date) + chrono::hours(hour) + chrono::minutes(minute) + chrono::seconds(second);
    return chrono::duration_cast<chrono::microseconds>(at.time_since_epoch()).count();
}

std::optional<std::int64_t> clock_in(std::string_view text) {
    std::array<int, 6> parts{};
    constexpr std::array<std::pair<std::size_t, std::size_t>, 6> places{
        {{1, 4}, {6, 2}, {9, 2}, {12, 2}, {15, 2}, {18, 2}}};
    if (text.size() != 21) return std::nullopt;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const auto number = number_in(text.substr(places[i].first, places[i].second));
        if (!number || *number < 0) return std::nullopt;
        parts[i] = static_cast<int>(*number);
    }
    return clock_of(parts[0], parts[1], parts[2], parts[3], parts[4], parts[5]);
}

std::string clock_text(std::int64_t now) {
    const auto m = doppler::moment_of(now);
    std::array<char, 64> text{};
    std::snprintf(text.data(), text.size(), "%04d-%02d-%02d %02d:%02d:%02d", m.year(), m.month(), m.day(),
                  m.hour(), m.minute(), m.second());
    return text.data();
}

}  // namespace echoloop::nortek_console
