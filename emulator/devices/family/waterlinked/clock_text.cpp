#include "emulator/devices/family/waterlinked/clock_text.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>

namespace echoloop::waterlinked_family {
namespace {

using namespace std::chrono;

/// s that local time is ahead of UTC; nothing if the text is no offset.
std::optional<double> read_offset(const std::string& text) {
    if (text == "Z" || text == "z") return 0;
    char sign = 0, more = 0;
    unsigned hour = 0, minute = 0;
    if (std::sscanf(text.c_str(), "%c%2u:%2u%c", &sign, &hour, &minute, &more) != 3) return std::nullopt;
    if ((sign != '+' && sign != '-') || hour > 23 || minute > 59) return std::nullopt;
    return (sign == '-' ? -1.0 : 1.0) * (3600.0 * hour + 60.0 * minute);
}

}  // namespace

std::string rfc3339(double unix_time) {
    const auto whole = sys_seconds(seconds(static_cast<std::int64_t>(std::floor(unix_time))));
    const auto day = floor<days>(whole);
    const year_month_day date(day);
    const hh_mm_ss time(whole - day);
    const auto micros = static_cast<int>((unix_time - std::floor(unix_time)) * 1e6);
    char text[48];
    std::snprintf(text, sizeof text, "%04d-%02u-%02uT%02d:%02d:%02d.%06dZ", static_cast<int>(date.year()),
                  static_cast<unsigned>(date.month()), static_cast<unsigned>(date.day()),
                  static_cast<int>(time.hours().count()), static_cast<int>(time.minutes().count()),
                  static_cast<int>(time.seconds().count()), micros);
    return text;
}

std::optional<double> read_rfc3339(const std::string& text) {
    int y = 0, used = 0;
    unsigned m = 0, d = 0, hour = 0, minute = 0, second = 0;
    if (text.size() > 40 || std::sscanf(text.c_str(), "%4d-%2u-%2u%*1[Tt ]%2u:%2u:%2u%n", &y, &m, &d, &hour,
                                        &minute, &second, &used) != 6)
        return std::nullopt;
    auto at = static_cast<std::size_t>(used);
    double fraction = 0, place = 0.1;
    if (at < text.size() && text[at] == '.')
        for (++at; at < text.size() && text[at] >= '0' && text[at] <= '9'; ++at, place /= 10)
            fraction += place * (text[at] - '0');
    const year_month_day date{year{y}, month{m}, day{d}};
    const auto offset = read_offset(text.substr(at));
    if (!date.ok() || hour > 23 || minute > 59 || second > 60 || !offset) return std::nullopt;
    const auto days_since = sys_days(date).time_since_epoch().count();
    return 86400.0 * static_cast<double>(days_since) + 3600.0 * hour + 60.0 * minute + second + fraction -
           *offset;
}

bool is_host(const std::string& text) {
    constexpr std::size_t longest = 253;
    return !text.empty() && text.size() <= longest && std::ranges::all_of(text, [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' ||
               c == ':' || c == '-';
    });
}

}  // namespace echoloop::waterlinked_family
