#include "emulator/devices/aris/date_time.h"

#include <charconv>
#include <chrono>
#include <string_view>

namespace echoloop::aris_device {
namespace {

constexpr std::string_view pattern = "0000-Aaa-00 00:00:00";  // 0: a digit
constexpr std::size_t day_at = 9;

std::optional<unsigned> digits(std::string_view text) {
    unsigned value = 0;
    const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (fault != std::errc{} || end != text.data() + text.size()) return std::nullopt;
    return value;
}

/// 1 to 12.
std::optional<unsigned> month_of(std::string_view name) {
    constexpr std::string_view months = "JanFebMarAprMayJunJulAugSepOctNovDec";
    const std::size_t at = months.find(name);
    if (at == std::string_view::npos || at % 3 != 0) return std::nullopt;
    return static_cast<unsigned>(at / 3 + 1);
}

std::optional<std::int64_t> read_padded(std::string_view text) {
    if (text.size() != pattern.size()) return std::nullopt;
    for (std::size_t i = 0; i < text.size(); ++i)
        if (std::string_view("- :").find(pattern[i]) != std::string_view::npos && text[i] != pattern[i])
            return std::nullopt;
    const auto year = digits(text.substr(0, 4)), month = month_of(text.substr(5, 3)),
               day = digits(text.substr(day_at, 2)), hour = digits(text.substr(12, 2)),
               minute = digits(text.substr(15, 2)), second = digits(text.substr(18, 2));
    if (!year || !month || !day || !hour || !minute || !second) return std::nullopt;
    const std::chrono::year_month_day date{std::chrono::year(static_cast<int>(*year)),
                                           std::chrono::month(*month), std::chrono::day(*day)};
    if (!date.ok() || *hour > 23 || *minute > 59 || *second > 60) return std::nullopt;
    const auto days = std::chrono::sys_days(date).time_since_epoch();
    return std::chrono::duration_cast<std::chrono::seconds>(days).count() + *hour * 3600 + *minute * 60 +
           *second;
}

}  // namespace

std::optional<std::int64_t> read_date_time(std::string text) {
    if (text.size() + 1 == pattern.size()) text.insert(day_at, 1, '0');  // as the maker's own host writes it
    return read_padded(text);
}

}  // namespace echoloop::aris_device
