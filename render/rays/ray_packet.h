// What neighbouring rays of a view met becomes its pixels: the arithmetic of gl/fan_shader for each, in the
// widest vectors of the processor. Knows no tree.
#pragma once

#include <array>
#include <cstddef>

#include "render/pixel.h"

namespace echoloop::rays {

/// Rays that are looked for at once: a tile of a picture.
inline constexpr std::size_t tile_lines = 4, tile_samples = 4, packet_rays = tile_lines * tile_samples;
/// Of what tells which of them count, as Embree wants it.
inline constexpr std::size_t packet_alignment = packet_rays * sizeof(int);

/// The axes of a view in the scene's frame: a ray through the place (x, y) of the image plane goes along
/// x starboard + y up + forward.
struct ViewAxes {
    float starboard[3], up[3], forward[3];
};

/// Size of a pixel on the image plane, and of a usual one in pixels.
struct PixelSizes {
    float width, height, usual_width, usual_height;
};

/// Hits along a line of the picture, one number of each, in the scene's frame.
struct HitArrays {
    static constexpr std::size_t most = 8 * tile_samples;
    using Numbers = std::array<float, most>;
    Numbers depth;                         ///< how often a ray's direction goes from the eye to the hit
    Numbers plane_x, plane_y, plane_z;     ///< normal of the triangle, of any length
    Numbers normal_x, normal_y, normal_z;  ///< that of the surface
    Numbers lean;                          ///< variance of the normal in the direction of the ray
    Numbers surface;                       ///< as Pixel::surface; 0: nothing is met
};

/// Where the rays of a tile go: `x` and `y` of each, line by line.
void find_directions(const ViewAxes& axes, const float* x, const float* y, float* to_x, float* to_y,
                     float* to_z);

/// Of rays that bend and of hits where we see them: the water's upward direction in the view's axes, and of
/// each hit the bow of its ray over the level distance, in rad/m, so that a ray arrives with its direction
/// here turned down by the bow.
struct Bows {
    std::array<float, 3> up;
    HitArrays::Numbers of;
};

/// The pixels of one line, whose `count` samples are at those `y`. `bows`: null where the direction from us
/// is that of arrival.
void find_pixels(const ViewAxes& axes, const PixelSizes& sizes, float x, const float* y,
                 const HitArrays& hits, std::size_t count, Pixel* pixels, const Bows* bows = nullptr);

}  // namespace echoloop::rays
