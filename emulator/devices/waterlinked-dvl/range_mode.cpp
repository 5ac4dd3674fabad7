#include "emulator/devices/waterlinked-dvl/range_mode.h"

#include <algorithm>
#include <array>

namespace echoloop::waterlinked_dvl {
namespace {

// The maker's table; where it gives a span of rates, the middle of it.
constexpr std::array table{Mode{0.05, 0.6, 15}, Mode{0.3, 3, 10}, Mode{1.5, 14, 5.5}, Mode{7.7, 36, 7.5},
                           Mode{15, 0, 3}};

std::optional<std::size_t> digit(char c) {
    const auto place = static_cast<std::size_t>(c - '0');
    return c >= '0' && place < table.size() ? std::optional(place) : std::nullopt;
}

}  // namespace

std::optional<RangeMode> read_range_mode(std::string_view text) {
    RangeMode mode;
    mode.text = text;
    if (text == "auto") return mode;
    mode.water = text == "wt";
    if (mode.water) return mode;
    const bool one = text.size() == 2 && text[0] == '=';
    const bool span = text.size() == 4 && text.substr(1, 2) == "<=";
    if (!one && !span) return std::nullopt;
    const auto from = digit(one ? text[1] : text[0]), to = digit(text.back());
    if (!from || !to || *from > *to) return std::nullopt;
    mode.lowest = *from;
    mode.highest = *to;
    return mode;
}

Modes range_modes(double highest_altitude) {
    Modes modes(table.begin(), table.end());
    for (Mode& mode : modes) mode.farthest = std::min(mode.farthest, highest_altitude);
    modes.back().farthest = highest_altitude;
    return modes;
}

}  // namespace echoloop::waterlinked_dvl
