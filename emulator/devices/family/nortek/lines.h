// Lines of Nortek's command interface: plain, or as sentences "$PNOR,...*hh"; words, clocks, the login. Pure
// functions and one small state machine; knows no line.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace echoloop::nortek_console {

/// What a host has said.
struct Words {
    std::vector<std::string> all;  ///< in capitals, but for what stands in quotes; one at least
    bool sentence = false;         ///< it is answered as such
    bool sound = true;             ///< its sum fits
};
Words read_words(std::string_view line);

/// One line of an answer, with its end.
std::string ended(const std::string& line, bool sentence);

std::optional<double> number_in(std::string_view text);

/// us, Unix time, of "2026-11-27 12:30:15" in quotes.
std::optional<std::int64_t> clock_in(std::string_view text);
/// us, Unix time, of a date and a time of day, if there is such a one.
std::optional<std::int64_t> clock_of(int year, int month, int day, int hour, int minute, int second);
/// "2026-11-27 12:30:15", without quotes. `now`: us, Unix time.
std::string clock_text(std::int64_t now);

}  // namespace echoloop::nortek_console
