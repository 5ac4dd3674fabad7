// The range of a sounder that follows the bottom. A pure function.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>

namespace echoloop::echosounder {

/// mm of the next ping: as it is while the bottom lies between two and four fifths of it, else half as far
/// again as the bottom, in whole metres; twice as far where there is no bottom.
inline std::uint32_t next_length(std::uint32_t length, std::optional<std::uint32_t> bottom,
                                 std::uint32_t shortest, std::uint32_t longest) {
    constexpr std::uint32_t step = 1000;  // mm
    if (!bottom) return std::clamp(2 * length, shortest, longest);
    if (*bottom >= length / 5 * 2 && *bottom <= length / 5 * 4) return length;
    return std::clamp((*bottom * 3 / 2 + step - 1) / step * step, shortest, longest);
}

}  // namespace echoloop::echosounder
