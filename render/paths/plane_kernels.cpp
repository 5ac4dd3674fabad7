#include "render/paths/plane_kernels.h"

#include <cmath>

#include "render/simd.h"

namespace echoloop {
namespace {

ECHOLOOP_SIMD
void mark(const double* __restrict x, const double* __restrict y, const double* __restrict z,
          const double* __restrict offset, const double* __restrict mx, const double* __restrict my,
          const double* __restrict mz, const double* __restrict reach2, double px, double py, double pz,
          double end, double resolution, std::ptrdiff_t count, std::uint8_t* __restrict marks) {
    for (std::ptrdiff_t i = 0; i < count; ++i) {
        const double distance = x[i] * px + y[i] * py + z[i] * pz - offset[i];
        const double range = std::abs(distance);
        const double dx = mx[i] - px, dy = my[i] - py, dz = mz[i] - pz;
        const double off2 = dx * dx + dy * dy + dz * dz - distance * distance;
        const double most2 = 2 * reach2[i] + 4 * range * resolution;
        marks[i] = static_cast<std::uint8_t>((range < end) & (off2 <= most2));
    }
}

ECHOLOOP_SIMD
void reflect_all(const double* __restrict x, const double* __restrict y, const double* __restrict z,
                 const double* __restrict offset, const double* __restrict own, double ix, double iy,
                 double iz, double distance2, double* __restrict before, double* __restrict next2) {
    for (std::size_t i = 0; i < FewPlanes::most; ++i) {
        const double b = x[i] * ix + y[i] * iy + z[i] * iz - offset[i];
        before[i] = b;
        next2[i] = distance2 + 4 * b * own[i];
    }
}

}  // namespace

void PlaneArrays::resize(std::size_t count) {
    for (auto* numbers : {&x, &y, &z, &offset, &middle_x, &middle_y, &middle_z, &reach2})
        numbers->resize(count);
}

void PlaneArrays::set(std::size_t i, Vec3 normal, double plane_offset, Vec3 middle, double reach) {
    x[i] = normal.x, y[i] = normal.y, z[i] = normal.z, offset[i] = plane_offset;
    middle_x[i] = middle.x, middle_y[i] = middle.y, middle_z[i] = middle.z;
    reach2[i] = reach * reach;
}

void mark_near(const PlaneArrays& planes, Vec3 point, double end, double resolution, std::uint8_t* marks) {
    mark(planes.x.data(), planes.y.data(), planes.z.data(), planes.offset.data(), planes.middle_x.data(),
         planes.middle_y.data(), planes.middle_z.data(), planes.reach2.data(), point.x, point.y, point.z, end,
         resolution, static_cast<std::ptrdiff_t>(planes.size()), marks);
}

void reflect(const FewPlanes& planes, Vec3 image, double distance2, double* before, double* next2) {
    reflect_all(planes.x, planes.y, planes.z, planes.offset, planes.before, image.x, image.y, image.z,
                distance2, before, next2);
}

}  // namespace echoloop
