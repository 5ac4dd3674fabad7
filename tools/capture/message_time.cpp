#include "tools/capture/message_time.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <string_view>

namespace echoloop::capture {
namespace {

const inspect::Field* find(const inspect::Message& message, std::string_view ending) {
    const auto ends_so = [ending](const auto& field) {
        const std::string_view name = field.name;
        return name.ends_with(ending) &&
               (name.size() == ending.size() || name[name.size() - ending.size() - 1] == '.');
    };
    const auto found = std::ranges::find_if(message.fields, ends_so);
    return found == message.fields.end() ? nullptr : &*found;
}

double number(const inspect::Message& message, std::string_view ending) {
    const auto* field = find(message, ending);
    return field != nullptr && field->number ? *field->number : NAN;
}

std::string text(const inspect::Message& message, std::string_view ending) {
    const auto* field = find(message, ending);
    return field == nullptr ? "" : field->text;
}

/// Seconds and, in another field, their fraction.
std::optional<double> split_seconds(const inspect::Message& message) {
    struct Pair {
        std::string_view seconds, nanoseconds;
    };
    constexpr std::array pairs{Pair{"ping_seconds", "ping_nanoseconds"},
                               Pair{"header.seconds", "header.nanoseconds"},
                               Pair{"timestamp.seconds", "timestamp.nanos"}};
    for (const auto& [seconds, nanoseconds] : pairs) {
        const double time = number(message, seconds) + number(message, nanoseconds) * 1e-9;
        if (std::isfinite(time)) return time;
    }
    return {};
}

/// Seconds, and milliseconds of the second or of the day.
std::optional<double> seconds_and_milliseconds(const inspect::Message& message) {
    const double milliseconds = number(message, "milliseconds");
    const double time = number(message, "seconds") + std::fmod(milliseconds, 1000) * 1e-3;
    return std::isfinite(time) ? std::optional(time) : std::nullopt;
}

/// One number in its unit.
std::optional<double> one_number(const inspect::Message& message) {
    for (const auto name : {"sonar_time", "pwr_up_msec", "timestamp_ms", "timestamp_msec", "timestamp",
                            "send_time", "start_time"}) {
        const auto* field = find(message, name);
        if (field == nullptr || !field->number || !std::isfinite(*field->number)) continue;
        if (field->unit == "s") return *field->number;
        if (field->unit == "ms") return *field->number * 1e-3;
        if (field->unit == "us") return *field->number * 1e-6;
        if (field->unit == "ns") return *field->number * 1e-9;
    }
    return {};
}

constexpr double seconds_a_day = 86400;

/// Year, day of the year, hour, minute and seconds of a 7k record.
std::optional<double> day_of_year(const inspect::Message& message) {
    const double year = number(message, "time.year"), day = number(message, "time.day");
    const double of_day = number(message, "time.hours") * 3600 + number(message, "time.minutes") * 60 +
                          number(message, "time.seconds");
    if (!std::isfinite(year + day + of_day) || year < 1970 || year > 2200) return {};
    std::tm start{};
    start.tm_year = static_cast<int>(year) - 1900;
    start.tm_mday = 1;
    return static_cast<double>(::timegm(&start)) + (day - 1) * seconds_a_day + of_day;
}

/// "18-Nov-2016", "19:29:10" and ".17" of the makers' files.
std::optional<double> date_and_time(const inspect::Message& message) {
    constexpr std::string_view months = "JANFEBMARAPRMAYJUNJULAUGSEPOCTNOVDEC";
    char name[4] = "";
    std::tm at{};
    double hundredths = 0;
    if (std::sscanf(text(message, "date").c_str(), "%2d-%3c-%4d", &at.tm_mday, name, &at.tm_year) != 3)
        return {};
    if (std::sscanf(text(message, "time").c_str(), "%2d:%2d:%2d", &at.tm_hour, &at.tm_min, &at.tm_sec) != 3)
        return {};
    if (std::sscanf(text(message, "hundredths").c_str(), "%lf", &hundredths) != 1) hundredths = 0;
    for (char& c : name) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    const auto month = months.find(std::string_view(name, 3));
    if (month == months.npos || month % 3 != 0 || at.tm_year < 1970 || at.tm_year > 2200 ||
        !std::isfinite(hundredths))
        return {};
    at.tm_mon = static_cast<int>(month / 3);
    at.tm_year -= 1900;
    return static_cast<double>(::timegm(&at)) + hundredths;
}

}  // namespace

std::optional<double> message_time(const inspect::Message& message) {
    for (const auto source :
         {split_seconds, seconds_and_milliseconds, one_number, day_of_year, date_and_time})
        if (const auto time = source(message); time && *time >= 0) return time;
    return {};
}

}  // namespace echoloop::capture
