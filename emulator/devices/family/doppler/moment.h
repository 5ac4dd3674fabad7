// Times of the clock on the wall, as the words of Doppler logs have them.
#pragma once

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <string>

namespace echoloop::doppler {

struct Moment {
    std::chrono::year_month_day date;
    std::chrono::hh_mm_ss<std::chrono::microseconds> time;

    int year() const { return static_cast<int>(date.year()); }
    int month() const { return static_cast<int>(static_cast<unsigned>(date.month())); }
    int day() const { return static_cast<int>(static_cast<unsigned>(date.day())); }
    int hour() const { return static_cast<int>(time.hours().count()); }
    int minute() const { return static_cast<int>(time.minutes().count()); }
    int second() const { return static_cast<int>(time.seconds().count()); }
    int hundredth() const { return static_cast<int>(time.subseconds().count() / 10000); }
};

/// `unix_us`: us, Unix time.
inline Moment moment_of(std::int64_t unix_us) {
    const std::chrono::sys_time<std::chrono::microseconds> at{std::chrono::microseconds(unix_us)};
    const auto day = std::chrono::floor<std::chrono::days>(at);
    return {std::chrono::year_month_day(day), std::chrono::hh_mm_ss<std::chrono::microseconds>(at - day)};
}

/// YYMMDDhhmmsshh, the last of them hundredths.
inline std::string compact(const Moment& m) {
    char text[32];
    std::snprintf(text, sizeof text, "%02d%02d%02d%02d%02d%02d%02d", m.year() % 100, m.month(), m.day(),
                  m.hour(), m.minute(), m.second(), m.hundredth());
    return text;
}

/// `start`: s, Unix time at the start of the run.
inline std::int64_t unix_us(double start, std::chrono::nanoseconds since) {
    const auto whole = static_cast<std::int64_t>(start);
    return whole * 1'000'000 + static_cast<std::int64_t>((start - static_cast<double>(whole)) * 1e6 + 0.5) +
           since.count() / 1000;
}

}  // namespace echoloop::doppler
