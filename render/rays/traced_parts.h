// What a ray met of the trees of a scene, as numbers of a line of the picture. Knows no rays' shape.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "render/gl/seen.h"
#include "render/rays/detail_tree.h"
#include "render/rays/ray_packet.h"
#include "render/simd.h"

namespace echoloop::rays {

inline constexpr float near_end = 0.01F;  ///< m along the axis of a view, as gl/fan_shader
/// That are looked for one after the other: what is written one by one is not read in vectors right after.
inline constexpr std::size_t tiles_at_once = HitArrays::most / tile_samples;

using RotationRows = std::array<float, 9>;

/// A line of a picture: its place on the image plane, and all its samples.
struct TracedLine {
    float x;
    Pixel* pixels;
};

/// The trees that rays go through.
class TracedParts {
  public:
    /// By the number of an instance; without instances there is one.
    struct Part {
        const DetailTree* tree;
        const RotationRows* world_from_part;
    };

    TracedParts(RTCScene scene, std::span<const Part> parts, bool instances)
        : scene_(scene), parts_(parts), instances_(instances) {}

    RTCScene scene() const { return scene_; }

    /// Fills in one number of each but the depth, which is where the ray's `tfar` says. False where the
    /// surface is not there from behind.
    ECHOLOOP_INLINE bool take_hit(const RTCRayHit16& query, std::size_t lane, HitArrays& to,
                                  std::size_t at) const {
        const RTCHit16& hit = query.hit;
        const Part& part = parts_[instances_ ? hit.instID[0][lane] : 0];
        const TriangleCorners& corners = part.tree->corners(hit.geomID[lane])[hit.primID[lane]];
        const float u = hit.u[lane], v = hit.v[lane];
        std::array<float, 4> values;
        for (std::size_t i = 0; i < 4; ++i)
            values[i] = corners.first[i] + u * corners.to_second[i] + v * corners.to_third[i];
        std::array<float, 3> plane{hit.Ng_x[lane], hit.Ng_y[lane], hit.Ng_z[lane]};
        if (instances_) {
            turn(*part.world_from_part, values[0], values[1], values[2]);
            turn(*part.world_from_part, plane[0], plane[1], plane[2]);
        }
        const RTCRay16& ray = query.ray;
        if (hit.geomID[lane] == 0 &&
            ray.dir_x[lane] * plane[0] + ray.dir_y[lane] * plane[1] + ray.dir_z[lane] * plane[2] >= 0)
            return false;
        to.depth[at] = ray.tfar[lane];
        to.normal_x[at] = values[0], to.normal_y[at] = values[1], to.normal_z[at] = values[2];
        to.plane_x[at] = plane[0], to.plane_y[at] = plane[1], to.plane_z[at] = plane[2];
        to.surface[at] = static_cast<float>(static_cast<int>(values[3]));
        to.lean[at] = std::max(values[3] - to.surface[at] - 0.25F, 0.0F);
        return true;
    }

  private:
    static void turn(const RotationRows& m, float& x, float& y, float& z) {
        const float a = m[0] * x + m[1] * y + m[2] * z, b = m[3] * x + m[4] * y + m[5] * z,
                    c = m[6] * x + m[7] * y + m[8] * z;
        x = a, y = b, z = c;
    }

    RTCScene scene_;
    std::span<const Part> parts_;
    bool instances_;
};

/// How a view lies in the scene's frame.
struct ViewPlace {
    ViewAxes axes{};
    PixelSizes sizes{};
    std::array<float, 3> eye{};
    std::vector<float> y;  ///< of every sample, and of a tile beyond the last

    ViewPlace(const View& view, const gl::Outlook& outlook);
};

}  // namespace echoloop::rays
