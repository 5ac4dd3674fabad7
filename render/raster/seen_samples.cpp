#include "render/raster/seen_samples.h"

#include <algorithm>
#include <cstdint>

#include "render/simd.h"

namespace echoloop::raster {

ECHOLOOP_SIMD
void look_along(const Along& triangle, const float* __restrict y_of, int count, float* __restrict depth,
                float* __restrict nx, float* __restrict ny, float* __restrict nz, float* __restrict px,
                float* __restrict py, float* __restrict pz, float* __restrict surface,
                float* __restrict lean) {
    const float* const m = triangle.numbers;
    const float x = triangle.x, a = m[0] * x + m[8], b = m[1] * x + m[9], c = m[2] * x + m[10],
                d = m[3] * x + m[11], a_up = m[4], b_up = m[5], c_up = m[6], d_up = m[7];
    const float *const n = triangle.normals, *const s = triangle.surfaces;
    const float plane_x = triangle.side * m[3], plane_y = triangle.side * m[7],
                plane_z = triangle.side * m[11];
    for (int i = 0; i < count; ++i) {
        const float y = y_of[i], e0 = a + a_up * y, e1 = b + b_up * y, e2 = c + c_up * y;
        const float over = 1 / (e0 + e1 + e2), w0 = e0 * over, w1 = e1 * over, w2 = e2 * over;
        nx[i] = w0 * n[0] + w1 * n[3] + w2 * n[6];
        ny[i] = w0 * n[1] + w1 * n[4] + w2 * n[7];
        nz[i] = w0 * n[2] + w1 * n[5] + w2 * n[8];
        px[i] = plane_x, py[i] = plane_y, pz[i] = plane_z;
        depth[i] = 1 / (d + d_up * y);
        const float whole = w0 * s[0] + w1 * s[1] + w2 * s[2] + 0.25F;
        const auto number = static_cast<float>(static_cast<std::int32_t>(whole));
        surface[i] = number;
        lean[i] = std::max(whole - number - 0.25F, 0.0F);
    }
}

ECHOLOOP_SIMD
void bow_along(const Along& triangle, float b0, float b1, float b2, const float* __restrict y_of, int count,
               float* __restrict bow) {
    const float* const m = triangle.numbers;
    const float x = triangle.x, a = m[0] * x + m[8], b = m[1] * x + m[9], c = m[2] * x + m[10], a_up = m[4],
                b_up = m[5], c_up = m[6];
    for (int i = 0; i < count; ++i) {
        const float y = y_of[i], e0 = a + a_up * y, e1 = b + b_up * y, e2 = c + c_up * y;
        bow[i] = (b0 * e0 + b1 * e1 + b2 * e2) / (e0 + e1 + e2);
    }
}

}  // namespace echoloop::raster
