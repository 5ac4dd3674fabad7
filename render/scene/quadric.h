// Sum of squared distances to planes, and the point where it is least (Garland and Heckbert 1997). Pure
// geometry.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "render/pose.h"

namespace echoloop {

/// The sum over planes n.x = d of weight (n.x - d)^2, kept as x A x - 2 b x + c.
class Quadric {
  public:
    void add_plane(Vec3 n, double d, double weight) {
        const double products[6] = {n.x * n.x, n.x * n.y, n.x * n.z, n.y * n.y, n.y * n.z, n.z * n.z};
        for (std::size_t i = 0; i < 6; ++i) a_[i] += weight * products[i];
        b_ = b_ + (weight * d) * n;
        c_ += weight * d * d;
        weight_ += weight;
    }
    void add(const Quadric& other) {
        for (std::size_t i = 0; i < 6; ++i) a_[i] += other.a_[i];
        b_ = b_ + other.b_;
        c_ += other.c_;
        weight_ += other.weight_;
    }
    /// Root of the mean square distance at x.
    double rms(Vec3 x) const {
        return weight_ > 0 ? std::sqrt(std::max(0.0, (dot(x, times(x)) - 2 * dot(b_, x) + c_) / weight_)) : 0;
    }
    /// Where the sum is least; where it hardly depends on a direction, as close to `start` as can be.
    Vec3 lowest_near(Vec3 start) const {
        const double hold = 0.003 * (a_[0] + a_[3] + a_[5]) / 3;
        const double xx = a_[0] + hold, xy = a_[1], xz = a_[2], yy = a_[3] + hold, yz = a_[4],
                     zz = a_[5] + hold;
        const Vec3 cx{yy * zz - yz * yz, xz * yz - xy * zz, xy * yz - xz * yy};  // cofactors: A is symmetric
        const Vec3 cy{cx.y, xx * zz - xz * xz, xy * xz - xx * yz}, cz{cx.z, cy.z, xx * yy - xy * xy};
        const double determinant = xx * cx.x + xy * cx.y + xz * cx.z;
        if (!(determinant > 0)) return start;
        const Vec3 rest = b_ - times(start);
        return start + (1 / determinant) * Vec3{dot(cx, rest), dot(cy, rest), dot(cz, rest)};
    }

  private:
    Vec3 times(Vec3 x) const {
        return {a_[0] * x.x + a_[1] * x.y + a_[2] * x.z, a_[1] * x.x + a_[3] * x.y + a_[4] * x.z,
                a_[2] * x.x + a_[4] * x.y + a_[5] * x.z};
    }

    std::array<double, 6> a_{};  ///< xx xy xz yy yz zz
    Vec3 b_{};
    double c_ = 0, weight_ = 0;
};

}  // namespace echoloop
