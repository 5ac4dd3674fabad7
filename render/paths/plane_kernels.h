// What is asked of many planes at once, in loops that become SIMD. Plain numbers; knows no scene.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "render/pose.h"

namespace echoloop {

/// Planes and what lies on them, as numbers of each kind.
struct PlaneArrays {
    std::vector<double> x, y, z, offset;               ///< unit normal; m: dot(normal, p) in the plane
    std::vector<double> middle_x, middle_y, middle_z;  ///< m, of what lies on it
    std::vector<double> reach2;                        ///< m^2, of its farthest point from the middle

    void resize(std::size_t count);
    void set(std::size_t i, Vec3 normal, double plane_offset, Vec3 middle, double reach);
    std::size_t size() const { return x.size(); }
};

/// Marks the planes whose perpendicular from `point` ends less than `end` m away, within twice the square of
/// the reach and of an edge's delay of `resolution` m: more than those whose foot or edges count, never less.
void mark_near(const PlaneArrays& planes, Vec3 point, double end, double resolution, std::uint8_t* marks);

/// A few planes, of which none is left out.
struct FewPlanes {
    static constexpr std::size_t most = 16;
    double x[most] = {}, y[most] = {}, z[most] = {}, offset[most] = {};
    double before[most] = {};  ///< m, of the origin of all paths
};

/// For each plane: m, of `image` before it, and the square of the distance of the image's image from that
/// origin, `distance2` that of the image itself.
void reflect(const FewPlanes& planes, Vec3 image, double distance2, double* before, double* next2);

}  // namespace echoloop
