#include "render/rays/ray_packet.h"

#include <algorithm>
#include <cmath>

#include "render/simd.h"

namespace echoloop::rays {

ECHOLOOP_SIMD
void find_directions(const ViewAxes& axes, const float* x, const float* y, float* __restrict to_x,
                     float* __restrict to_y, float* __restrict to_z) {
    for (std::size_t i = 0; i < packet_rays; ++i) {
        to_x[i] = axes.starboard[0] * x[i] + axes.up[0] * y[i] + axes.forward[0];
        to_y[i] = axes.starboard[1] * x[i] + axes.up[1] * y[i] + axes.forward[1];
        to_z[i] = axes.starboard[2] * x[i] + axes.up[2] * y[i] + axes.forward[2];
    }
}

namespace {

struct FoundArrays {
    HitArrays::Numbers range, cosine, footprint;
};

/// As the shader: the mean echo of a rough surface, and the footprint from the triangle's plane n p = d, on
/// which 1 / depth = (x n starboard + y n up + n forward) / d. `count`: of whole vectors. `bends`: a normal n
/// turned up by the angle b |l|, where the direction is d = l + h w with w upwards, has with d the product
/// (1 - versine - h b s) n d + b s d^2 n w, where s = sine / (b |l|).
template <bool bends>
ECHOLOOP_INLINE void find(const ViewAxes& axes, const PixelSizes sizes, const float x,
                          const float* __restrict y_of, const float* __restrict depth_of,
                          const float* __restrict nx_of, const float* __restrict ny_of,
                          const float* __restrict nz_of, const float* __restrict px_of,
                          const float* __restrict py_of, const float* __restrict pz_of,
                          const float* __restrict lean_of, const float* __restrict bow_of,
                          const std::array<float, 3> water_up, int count, float* __restrict range,
                          float* __restrict cosine, float* __restrict footprint) {
    const float wx = water_up[0], wy = water_up[1], wz = water_up[2];
    const float sx = axes.starboard[0], sy = axes.starboard[1], sz = axes.starboard[2], ux = axes.up[0],
                uy = axes.up[1], uz = axes.up[2], fx = sx * x + axes.forward[0],
                fy = sy * x + axes.forward[1], fz = sz * x + axes.forward[2];
    const float usual_width = sizes.usual_width * sizes.width,
                usual_height = sizes.usual_height * sizes.height;
    for (int i = 0; i < count / whole_vector * whole_vector; ++i) {
        const float y = y_of[i], depth = depth_of[i], square = x * x + y * y + 1;
        const float length = std::sqrt(square);
        const float nx = nx_of[i], ny = ny_of[i], nz = nz_of[i];
        const float px = px_of[i], py = py_of[i], pz = pz_of[i];
        const float dx = ux * y + fx, dy = uy * y + fy, dz = uz * y + fz;
        const float plane_towards = px * dx + py * dy + pz * dz;
        float along = nx * dx + ny * dy + nz * dz;
        if (bends) {
            const float h = dx * wx + dy * wy + dz * wz, b = bow_of[i] * depth,
                        q = b * b * (square - h * h);  // of the angle
            const float s = b * (1 - q * (1 / 6.0F - q * (1 / 120.0F))),
                        versine = q * (0.5F - q * (1 / 24.0F - q * (1 / 720.0F)));
            along = (1 - versine - h * s) * along + s * square * (nx * wx + ny * wy + nz * wz);
        }
        const float towards = along / std::sqrt(square * (nx * nx + ny * ny + nz * nz));
        const float flat = std::min(std::max(plane_towards < 0 ? -towards : towards, 0.0F), 1.0F);
        const float lean = lean_of[i];
        const float rough = std::min(flat + lean * (1 - flat * flat) / std::max(flat, 0.1F), 1.0F);
        const float one_over = 1 / length, slope = length / plane_towards;
        const float along_bearing =
            usual_width * depth * std::abs(x * one_over - slope * (px * sx + py * sy + pz * sz));
        const float along_elevation =
            usual_height * depth * std::abs(y * one_over - slope * (px * ux + py * uy + pz * uz));
        const float far = depth * length;
        const float size = std::min(std::max(along_bearing, along_elevation), 0.5F * far);
        range[i] = far;
        cosine[i] = rough;
        footprint[i] = along_elevation >= along_bearing ? size : -size;
    }
}

ECHOLOOP_SIMD
void find_straight(const ViewAxes& axes, const PixelSizes sizes, float x, const float* y,
                   const HitArrays& hits, int count, FoundArrays& found) {
    find<false>(axes, sizes, x, y, hits.depth.data(), hits.normal_x.data(), hits.normal_y.data(),
                hits.normal_z.data(), hits.plane_x.data(), hits.plane_y.data(), hits.plane_z.data(),
                hits.lean.data(), nullptr, {}, count, found.range.data(), found.cosine.data(),
                found.footprint.data());
}

ECHOLOOP_SIMD
void find_bent(const ViewAxes& axes, const PixelSizes sizes, float x, const float* y, const HitArrays& hits,
               const Bows& bows, int count, FoundArrays& found) {
    find<true>(axes, sizes, x, y, hits.depth.data(), hits.normal_x.data(), hits.normal_y.data(),
               hits.normal_z.data(), hits.plane_x.data(), hits.plane_y.data(), hits.plane_z.data(),
               hits.lean.data(), bows.of.data(), bows.up, count, found.range.data(), found.cosine.data(),
               found.footprint.data());
}

}  // namespace

void find_pixels(const ViewAxes& axes, const PixelSizes& sizes, float x, const float* y,
                 const HitArrays& hits, std::size_t count, Pixel* pixels, const Bows* bows) {
    static_assert(HitArrays::most % whole_vector == 0);
    FoundArrays found;
    HitArrays::Numbers y_of{};
    std::copy_n(y, count, y_of.begin());
    const auto whole = static_cast<int>(padded(count));
    if (bows != nullptr)
        find_bent(axes, sizes, x, y_of.data(), hits, *bows, whole, found);
    else
        find_straight(axes, sizes, x, y_of.data(), hits, whole, found);
    for (std::size_t i = 0; i < count; ++i)
        pixels[i] = hits.surface[i] > 0
                        ? Pixel{found.range[i], found.cosine[i], found.footprint[i], hits.surface[i]}
                        : Pixel{};
}

}  // namespace echoloop::rays
