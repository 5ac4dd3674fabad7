// An 8-bit RGB image in memory; never touches a file.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace echoloop::draw {

/// In the order in which cairo keeps the pixels of CAIRO_FORMAT_RGB24 in memory.
struct Color {
    std::uint8_t b = 0, g = 0, r = 0, unused = 0;

    constexpr Color() = default;
    constexpr Color(std::uint8_t red, std::uint8_t green, std::uint8_t blue) : b(blue), g(green), r(red) {}
    friend bool operator==(Color x, Color y) { return x.r == y.r && x.g == y.g && x.b == y.b; }
};
static_assert(std::endian::native == std::endian::little && sizeof(Color) == 4);

/// `a` where t = 0, `b` where t = 1.
inline Color mix(Color a, Color b, double t) {
    const auto channel = [t](std::uint8_t from, std::uint8_t to) {
        return static_cast<std::uint8_t>(std::lround(from + (to - from) * std::clamp(t, 0.0, 1.0)));
    };
    return {channel(a.r, b.r), channel(a.g, b.g), channel(a.b, b.b)};
}

struct Image {
    int width = 0, height = 0;
    std::vector<Color> pixels;  ///< row-major, the top row first

    Image(int w, int h, Color fill) : width(w), height(h), pixels(static_cast<std::size_t>(w) * h, fill) {}

    Color& at(int x, int y) { return pixels[static_cast<std::size_t>(y) * width + x]; }
    const Color& at(int x, int y) const { return pixels[static_cast<std::size_t>(y) * width + x]; }
};

}  // namespace echoloop::draw
