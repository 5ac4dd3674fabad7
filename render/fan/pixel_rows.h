// One line of pixels as arrays of numbers, and the stretch of range that each pixel of a surround stands for.
// Keeps to the pixel: it never smooths across an edge.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "render/fan/binning.h"
#include "render/ray_table.h"

namespace echoloop {

/// `footprint`: m, see Pixel. `inverse`: 1/m, of range; 0 where there is no surface.
struct PixelArrays {
    const float *range, *cosine, *footprint, *surface, *inverse;
};

/// A level plane as the directions of one line meet it, the water's surface from below: at height / u, with u
/// the part upwards of a direction of unit length. For a direction (1, x, y) of the image plane u is
/// (upright + per_sample y) / |(1, x, y)|.
struct PlaneOfLine {
    float height;                         ///< m, of the plane over the eye
    float upright, per_line, per_sample;  ///< the first at y = 0; what x and y add
    float x;                              ///< of the line
    float top, sample_height;             ///< y of the first sample, and how far the next is below it
    float usual_line, usual_sample;       ///< size of a usual pixel on the image plane
    float farthest;                       ///< m; beyond, nothing is drawn
    float number;                         ///< as Pixel::surface
    const RayTable::Surfacing* surfacing = nullptr;  ///< null: rays are straight
    float deeper = 1;                                ///< the height over that of the rays' surface
};

/// A line's pixels, one array per quantity, with a neighbour at both ends that goes on as the line does.
class PixelRow {
  public:
    /// `end`: m, of the window. Nothing is drawn that lies beyond; a plane that only just reaches there goes
    /// on by a pixel, so that it does not look like an outline. `plane`: hides what lies beyond it; null:
    /// none.
    void load(const Pixel* pixels, std::size_t count, float end, const PlaneOfLine* plane = nullptr);
    const float* range() const { return range_.data() + 1; }
    const float* cosine() const { return cosine_.data() + 1; }
    const float* footprint() const { return footprint_.data() + 1; }
    const float* surface() const { return surface_.data() + 1; }
    PixelArrays arrays() const { return {range(), cosine(), footprint(), surface(), inverse_.data() + 1}; }

  private:
    void go_on_beyond(float end, std::size_t missing, std::size_t nearest, std::size_t next);

    std::vector<float> range_, cosine_, footprint_, surface_, inverse_;
};

/// Number of samples from the first on that show one surface.
std::size_t count_alike(const float* surface, std::size_t count);

/// Change of range across a pixel, from the size of its footprint and its neighbours' ranges. The plane of a
/// facet may reach much farther than the facet, as on the crest of a ripple, so it goes at most half as far
/// again as the step to the nearer neighbour. A side without a surface tells nothing.
inline float range_step(float before, float before_surface, float range, float after, float after_surface,
                        float footprint) {
    constexpr float none = 1e30F;
    const float from_before = before_surface == 0 ? none : range - before;
    const float to_after = after_surface == 0 ? none : after - range;
    const float nearer = std::abs(from_before) < std::abs(to_after) ? from_before : to_after;
    return std::copysign(std::min(footprint, 1.5F * std::abs(nearer)), nearer);
}

/// What a sample's echo is spread over: the plane of its surface, as far as a pixel of the usual size shows
/// it. A function of the sample alone, so that the mean over pings does not depend on the number of pixels.
struct EchoSpread {
    explicit EchoSpread(const View& view)
        : most_across(static_cast<float>(most * view.usual_width * view.line_width())),
          most_along(static_cast<float>(most * view.usual_height * view.sample_height())) {}

    /// m. `footprint`: of PixelArrays.
    float half(float footprint, float range) const {
        return 0.5F * std::min(std::abs(footprint), range * (footprint < 0 ? most_across : most_along));
    }

    /// A plane at less than 1 deg of grazing reaches farther than its facet, as on a ripple's crest.
    static constexpr double most = 60;
    float most_across, most_along;
};

/// m, one per pixel: a stretch around the sample.
struct Extents {
    std::vector<float> near, far;
};

/// Pixels without a surface get meaningless extents.
void find_extents(const PixelRow& row, const View& view, Extents& extents);

}  // namespace echoloop
