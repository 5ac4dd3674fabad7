// Which triangles of a node a view may show, and the planes that tell where: in the widest vectors of the
// processor. Knows no pixels.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "render/raster/seen_corners.h"

namespace echoloop::raster {

/// Linear functions of the place (x, y) on the image plane, a x + b y + c, of a triangle with corners 0, 1
/// and 2. First of each corner its share at a point times one positive number: all are positive within, and
/// one is negative outside. Then what 1 over the distance along the axis is there, and where rays have
/// shadows what is not negative out of them.
struct TrianglePlanes {
    static constexpr std::size_t corners = 0, inverse = 9, clear = 12;
    static constexpr std::size_t numbers = 12, numbers_with_clear = 15;
};

/// Of a triangle that may show.
struct SeenTriangle {
    std::int32_t triangle;  ///< in the node
    std::int32_t turned;    ///< 1: seen from behind, and corners 1 and 2 have changed places
    std::int32_t first_line, last_line, first_sample, last_sample;  ///< all that it may cover
};

class NodeTriangles {
  public:
    /// Three indices a triangle.
    void take(std::span<const std::uint16_t> indices);

    /// Of those taken that turn their front to us or are double-sided, finds what may cover a sample.
    void find(const SeenCorners& corners, bool double_sided, const SampleGrid& grid);

    /// Fills in TrianglePlanes::clear by BentRay::clearance at the corners.
    void find_clear(const float* clearance);

    std::span<const SeenTriangle> seen() const { return std::span(seen_).first(count_); }
    /// One of TrianglePlanes' numbers of every triangle seen; the next number lies stride() behind it.
    const float* planes(std::size_t number) const { return planes_.data() + number * stride(); }
    std::size_t stride() const { return padded(count_); }
    /// The number of corner 0, 1 or 2 of a triangle seen.
    std::size_t corner(std::size_t seen, std::size_t k) const {
        return static_cast<std::size_t>(seen_corners_[seen + k * stride()]);
    }

  private:
    void find_seen(const SeenCorners& corners, bool double_sided, const SampleGrid& grid);
    void add_across_near_end(std::int32_t triangle, const SeenCorners& corners, bool double_sided,
                             const SampleGrid& grid);

    std::size_t triangles_ = 0, count_ = 0;
    std::array<std::vector<std::int32_t>, 3> corners_;
    std::vector<std::int32_t> boxes_, seen_corners_;
    std::vector<SeenTriangle> seen_;
    std::vector<float> planes_;
};

}  // namespace echoloop::raster
