// An 8-bit RGB image in memory; never touches a file.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace echoloop::draw {

struct Color {
    std::uint8_t r = 0, g = 0, b = 0;
    friend bool operator==(const Color&, const Color&) = default;
};

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

    /// Lays `color` over a pixel; outside the image nothing happens.
    void blend(int x, int y, Color color, double alpha = 1) {
        if (x < 0 || y < 0 || x >= width || y >= height) return;
        at(x, y) = mix(at(x, y), color, alpha);
    }
};

}  // namespace echoloop::draw
