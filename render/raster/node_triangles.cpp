#include "render/raster/node_triangles.h"

#include <algorithm>
#include <cmath>

#include "render/simd.h"

namespace echoloop::raster {
namespace {

/// Of a line or a sample: places on the image plane are rounded.
constexpr float margin = 1 / 64.0F;

/// Triples of indices, one row for each corner.
ECHOLOOP_SIMD
void unpack_corners(const std::uint16_t* __restrict indices, int triangles, std::int32_t* __restrict corner_0,
                    std::int32_t* __restrict corner_1, std::int32_t* __restrict corner_2) {
    for (int i = 0; i < triangles; ++i) {
        corner_0[i] = indices[3 * i];
        corner_1[i] = indices[3 * i + 1];
        corner_2[i] = indices[3 * i + 2];
    }
}

/// A triangle as find_boxes() tells of it.
constexpr std::int32_t unseen = 0, front = 1, back = 2, across_near_end = 4;

/// Rows of `count` numbers each: first and last line, first and last sample, and what the triangle shows if
/// anything. `sides`: front or, double-sided, front + back. `across`: some corners are not in front of the
/// near end, and what reaches over it has no box on the image plane.
template <bool across>
ECHOLOOP_INLINE void find_boxes(const std::int32_t* __restrict corner_0,
                                const std::int32_t* __restrict corner_1,
                                const std::int32_t* __restrict corner_2, int count, int sides,
                                const float* __restrict line, const float* __restrict sample,
                                const float* __restrict z, const SampleGrid grid,
                                std::int32_t* __restrict first_line, std::int32_t* __restrict last_line,
                                std::int32_t* __restrict first_sample, std::int32_t* __restrict last_sample,
                                std::int32_t* __restrict shown) {
    const auto lines = static_cast<float>(grid.lines), samples = static_cast<float>(grid.samples);
    // Of what is within -1..most, the whole number below it: what is positive is cut off.
    const auto below = [](float v, float most) {
        return static_cast<std::int32_t>(std::min(std::max(v + 1, 0.0F), most)) - 1;
    };
    for (int i = 0; i < count / whole_vector * whole_vector; ++i) {
        const std::int32_t a = corner_0[i], b = corner_1[i], c = corner_2[i];
        const float la = line[a], lb = line[b], lc = line[c], sa = sample[a], sb = sample[b], sc = sample[c];
        const float low_line = std::min(std::min(la, lb), lc) - margin,
                    high_line = std::max(std::max(la, lb), lc) + margin,
                    low_sample = std::min(std::min(sa, sb), sc) - margin,
                    high_sample = std::max(std::max(sa, sb), sc) + margin;
        const std::int32_t l0 = grid.lines - 1 - below(lines - 1 - low_line, lines),
                           l1 = below(high_line, lines),
                           s0 = grid.samples - 1 - below(samples - 1 - low_sample, samples),
                           s1 = below(high_sample, samples);
        const float area = (lb - la) * (sc - sa) - (lc - la) * (sb - sa);
        const std::int32_t side = area < 0 ? front : back;
        std::int32_t shows = ((side & sides) != 0) & (l0 <= l1) & (s0 <= s1) ? side : unseen;
        if (across) {
            const float za = z[a], zb = z[b], zc = z[c], nearest = std::min(std::min(za, zb), zc),
                        farthest = std::max(std::max(za, zb), zc);
            shows = nearest > near_end ? shows : farthest > near_end ? across_near_end : unseen;
        }
        first_line[i] = l0, last_line[i] = l1, first_sample[i] = s0, last_sample[i] = s1;
        shown[i] = shows;
    }
}

ECHOLOOP_SIMD
void find_boxes_in_front(const std::int32_t* __restrict corner_0, const std::int32_t* __restrict corner_1,
                         const std::int32_t* __restrict corner_2, int count, int sides,
                         const float* __restrict line, const float* __restrict sample,
                         const float* __restrict z, const SampleGrid grid,
                         std::int32_t* __restrict first_line, std::int32_t* __restrict last_line,
                         std::int32_t* __restrict first_sample, std::int32_t* __restrict last_sample,
                         std::int32_t* __restrict shown) {
    find_boxes<false>(corner_0, corner_1, corner_2, count, sides, line, sample, z, grid, first_line,
                      last_line, first_sample, last_sample, shown);
}

ECHOLOOP_SIMD
void find_boxes_around(const std::int32_t* __restrict corner_0, const std::int32_t* __restrict corner_1,
                       const std::int32_t* __restrict corner_2, int count, int sides,
                       const float* __restrict line, const float* __restrict sample,
                       const float* __restrict z, const SampleGrid grid, std::int32_t* __restrict first_line,
                       std::int32_t* __restrict last_line, std::int32_t* __restrict first_sample,
                       std::int32_t* __restrict last_sample, std::int32_t* __restrict shown) {
    find_boxes<true>(corner_0, corner_1, corner_2, count, sides, line, sample, z, grid, first_line, last_line,
                     first_sample, last_sample, shown);
}

/// As TrianglePlanes. What two neighbours see of the edge between them is the same number but for its sign,
/// so that no sample falls between them.
ECHOLOOP_SIMD
void find_planes(const std::int32_t* __restrict corner_0, const std::int32_t* __restrict corner_1,
                 const std::int32_t* __restrict corner_2, int count, const float* __restrict x,
                 const float* __restrict y, const float* __restrict z, float* __restrict to) {
    const int stride = count;
// No row is written over another.
#pragma GCC ivdep
    for (int i = 0; i < count / whole_vector * whole_vector; ++i) {
        const std::int32_t a = corner_0[i], b = corner_1[i], c = corner_2[i];
        const float ax = x[a], ay = y[a], az = z[a], bx = x[b], by = y[b], bz = z[b], cx = x[c], cy = y[c],
                    cz = z[c];
        const float abx = bx - ax, aby = by - ay, abz = bz - az, bcx = cx - bx, bcy = cy - by, bcz = cz - bz,
                    cax = ax - cx, cay = ay - cy, caz = az - cz;
        const float pbx = bx + cx, pby = by + cy, pbz = bz + cz, pcx = cx + ax, pcy = cy + ay, pcz = cz + az,
                    pax = ax + bx, pay = ay + by, paz = az + bz;
        to[i] = pby * bcz - pbz * bcy;
        to[i + stride] = pbz * bcx - pbx * bcz;
        to[i + 2 * stride] = pbx * bcy - pby * bcx;
        to[i + 3 * stride] = pcy * caz - pcz * cay;
        to[i + 4 * stride] = pcz * cax - pcx * caz;
        to[i + 5 * stride] = pcx * cay - pcy * cax;
        to[i + 6 * stride] = pay * abz - paz * aby;
        to[i + 7 * stride] = paz * abx - pax * abz;
        to[i + 8 * stride] = pax * aby - pay * abx;
        const float nx = cay * abz - caz * aby, ny = caz * abx - cax * abz, nz = cax * aby - cay * abx;
        const float over = 1 / (nx * ax + ny * ay + nz * az);
        to[i + 9 * stride] = nx * over, to[i + 10 * stride] = ny * over, to[i + 11 * stride] = nz * over;
    }
}

}  // namespace

void NodeTriangles::take(std::span<const std::uint16_t> indices) {
    triangles_ = indices.size() / 3;
    if (triangles_ == 0) return;
    for (auto& corner : corners_)
        if (corner.size() < padded(triangles_)) corner.resize(padded(triangles_));
    unpack_corners(indices.data(), static_cast<int>(triangles_), corners_[0].data(), corners_[1].data(),
                   corners_[2].data());
    for (auto& corner : corners_)
        std::fill(corner.data() + triangles_, corner.data() + padded(triangles_), corner[0]);
}

void NodeTriangles::find(const SeenCorners& corners, bool double_sided, const SampleGrid& grid) {
    count_ = 0;
    if (corners.behind() == corners.count()) return;
    if (seen_.size() < triangles_ + 1) seen_.resize(triangles_ + 1);
    find_seen(corners, double_sided, grid);
    if (count_ == 0) return;
    const std::size_t apart = stride();
    if (seen_corners_.size() < 3 * apart) seen_corners_.resize(3 * apart);
    const std::size_t numbers = TrianglePlanes::numbers_with_clear * apart;
    if (planes_.size() < numbers) planes_.resize(numbers);
    for (std::size_t i = 0; i < count_; ++i) {
        const auto triangle = static_cast<std::size_t>(seen_[i].triangle);
        const std::int32_t turned = seen_[i].turned;
        seen_corners_[i] = corners_[0][triangle];
        seen_corners_[i + apart] = corners_[turned == 0 ? 1 : 2][triangle];
        seen_corners_[i + 2 * apart] = corners_[turned == 0 ? 2 : 1][triangle];
    }
    for (std::int32_t* row = seen_corners_.data(); row < seen_corners_.data() + 3 * apart; row += apart)
        std::fill(row + count_, row + apart, row[0]);
    find_planes(seen_corners_.data(), seen_corners_.data() + apart, seen_corners_.data() + 2 * apart,
                static_cast<int>(apart), corners.x(), corners.y(), corners.z(), planes_.data());
}

void NodeTriangles::find_clear(const float* clearance) {
    float* const to = planes_.data();
    for (std::size_t i = 0; i < count_; ++i)
        for (std::size_t k = 0; k < 3; ++k) {
            float sum = 0;
            for (std::size_t c = 0; c < 3; ++c)
                sum += clearance[corner(i, c)] * to[i + (3 * c + k) * stride()];
            to[i + (TrianglePlanes::clear + k) * stride()] = sum;
        }
}

void NodeTriangles::find_seen(const SeenCorners& corners, bool double_sided, const SampleGrid& grid) {
    const std::size_t apart = padded(triangles_);
    if (boxes_.size() < 6 * apart) boxes_.resize(6 * apart);
    std::array<std::int32_t*, 6> rows;
    for (std::size_t i = 0; i < rows.size(); ++i) rows[i] = boxes_.data() + i * apart;
    const std::int32_t* const shown = rows[4];
    (corners.behind() == 0 ? find_boxes_in_front : find_boxes_around)(
        corners_[0].data(), corners_[1].data(), corners_[2].data(), static_cast<int>(apart),
        double_sided ? front + back : front, corners.line(), corners.sample(), corners.z(), grid, rows[0],
        rows[1], rows[2], rows[3], rows[4]);
    std::int32_t* const numbers = rows[5];
    std::size_t found = 0;
    for (std::size_t i = 0; i < triangles_; ++i) {
        numbers[found] = static_cast<std::int32_t>(i);
        found += shown[i] != unseen ? 1 : 0;
    }
    for (std::size_t k = 0; k < found; ++k) {
        const std::int32_t i = numbers[k];
        if (shown[i] == across_near_end)
            add_across_near_end(i, corners, double_sided, grid);
        else
            seen_[count_++] = {i, shown[i] == back ? 1 : 0, rows[0][i], rows[1][i], rows[2][i], rows[3][i]};
    }
}

/// A triangle that reaches behind the sonar: it may cover every sample.
void NodeTriangles::add_across_near_end(std::int32_t triangle, const SeenCorners& corners, bool double_sided,
                                        const SampleGrid& grid) {
    const float *x = corners.x(), *y = corners.y(), *z = corners.z();
    const auto i = static_cast<std::size_t>(triangle);
    const std::int32_t a = corners_[0][i], b = corners_[1][i], c = corners_[2][i];
    const float bx = x[b] - x[a], by = y[b] - y[a], bz = z[b] - z[a], cx = x[c] - x[a], cy = y[c] - y[a],
                cz = z[c] - z[a];
    const float volume = x[a] * (by * cz - bz * cy) + y[a] * (bz * cx - bx * cz) + z[a] * (bx * cy - by * cx);
    if (volume > 0 || (volume < 0 && double_sided))
        seen_[count_++] = {triangle, volume > 0 ? 0 : 1, 0, grid.lines - 1, 0, grid.samples - 1};
}

}  // namespace echoloop::raster
