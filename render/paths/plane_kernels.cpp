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
void reflect_all(const FewPlanes& __restrict p, double ox, double oy, double oz, double ix, double iy,
                 double iz, double distance2, Reflected& __restrict out) {
    for (std::size_t i = 0; i < FewPlanes::most; ++i) {
        const double b = p.x[i] * ix + p.y[i] * iy + p.z[i] * iz - p.offset[i];
        const double share = p.before[i] / (p.before[i] + b);
        const double dx = ox + share * (ix - 2 * b * p.x[i] - ox) - p.middle_x[i];
        const double dy = oy + share * (iy - 2 * b * p.y[i] - oy) - p.middle_y[i];
        const double dz = oz + share * (iz - 2 * b * p.z[i] - oz) - p.middle_z[i];
        out.before[i] = b;
        out.next2[i] = distance2 + 4 * b * p.before[i];
        out.beside[i] = dx * dx + dy * dy + dz * dz - p.reach2[i];
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

void reflect(const FewPlanes& planes, Vec3 origin, Vec3 image, double distance2, Reflected& out) {
    reflect_all(planes, origin.x, origin.y, origin.z, image.x, image.y, image.z, distance2, out);
}

}  // namespace echoloop
