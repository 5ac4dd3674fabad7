// A fixed-width, NUL-padded character field as it stands on the wire. Never allocates and never loses a byte.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>

namespace echoloop::wire {

/// `Size` characters. Bytes behind the first NUL are kept, so that a parsed field is written back unchanged.
template <std::size_t Size>
struct Text {
    std::array<char, Size> chars{};

    constexpr Text() = default;
    /// Text beyond `Size` characters is cut.
    constexpr Text(std::string_view text) {
        std::copy_n(text.data(), std::min(Size, text.size()), chars.data());
    }
    constexpr Text(const char* text) : Text(std::string_view(text)) {}

    /// The characters before the first NUL.
    constexpr std::string_view view() const {
        const auto end = std::find(chars.begin(), chars.end(), '\0');
        return {chars.data(), static_cast<std::size_t>(end - chars.begin())};
    }
    friend constexpr bool operator==(const Text&, const Text&) = default;
};

}  // namespace echoloop::wire
