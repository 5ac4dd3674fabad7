// A ping's samples as they go on the wire, beam-major, and how datagrams take columns out of them. Knows no
// packet.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

namespace echoloop::r2sonic_device {

/// beams x columns cells of `cell` bytes, big-endian already.
struct Plane {
    std::size_t beams = 0, columns = 0, cell = 1;
    std::vector<std::uint8_t> bytes{};

    void make(std::size_t b, std::size_t c, std::size_t size) {
        beams = b, columns = c, cell = size;
        bytes.resize(b * c * size);
    }
    std::uint8_t* row(std::size_t beam) { return bytes.data() + beam * columns * cell; }
    const std::uint8_t* row(std::size_t beam) const { return bytes.data() + beam * columns * cell; }
};

/// Columns [first, first + count) of all beams, beam after beam, to `to`, which has room for them.
inline void copy_columns(const Plane& plane, std::size_t first, std::size_t count, std::uint8_t* to) {
    const std::size_t size = count * plane.cell;
    for (std::size_t beam = 0; beam < plane.beams; ++beam, to += size)
        std::copy_n(plane.row(beam) + first * plane.cell, size, to);
}

/// The same, column after column.
inline void copy_columns_first(const Plane& plane, std::size_t first, std::size_t count, std::uint8_t* to) {
    for (std::size_t column = first; column < first + count; ++column)
        for (std::size_t beam = 0; beam < plane.beams; ++beam, to += plane.cell)
            std::copy_n(plane.row(beam) + column * plane.cell, plane.cell, to);
}

}  // namespace echoloop::r2sonic_device
