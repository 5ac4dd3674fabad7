#include "render/raster/seen_corners.h"

#include <algorithm>
#include <cmath>

#include "render/simd.h"

namespace echoloop::raster {
namespace {

/// From positions that are there already. Returns how many are not in front of the near end.
ECHOLOOP_SIMD
int find_straight(int count, const PartPlace place, const SampleGrid grid, float* __restrict x_of,
                  float* __restrict y_of, float* __restrict z_of, float* __restrict line_of,
                  float* __restrict sample_of) {
    const auto& m = place.rows;
    const float ex = place.eye[0], ey = place.eye[1], ez = place.eye[2];
    const float near = near_end;
    int behind = 0;
    for (int i = 0; i < count; ++i) {
        const float dx = x_of[i] - ex, dy = y_of[i] - ey, dz = z_of[i] - ez;
        const float x = m[0] * dx + m[1] * dy + m[2] * dz, y = m[3] * dx + m[4] * dy + m[5] * dz,
                    z = m[6] * dx + m[7] * dy + m[8] * dz;
        const float inverse = 1 / (z > near ? z : near);
        x_of[i] = x, y_of[i] = y, z_of[i] = z;
        line_of[i] = (x * inverse - grid.first_x) * grid.lines_per_x;
        sample_of[i] = (grid.first_y - y * inverse) * grid.samples_per_y;
        behind += z <= near ? 1 : 0;
    }
    return behind;
}

/// Where a point is among a RayTable's cells.
struct TablePlaces {
    float columns_per_metre, middle, per_b, first_row;
};

/// As gl/fan_shader's bent_vertex_shader, from positions that are there already. All in the view's axes, so a
/// point moves along itself and upwards.
template <bool shadows>
ECHOLOOP_INLINE int find_bent(int count, const PartPlace& place, const SampleGrid& grid,
                              const TablePlaces& table, const float* __restrict cells, float* __restrict x_of,
                              float* __restrict y_of, float* __restrict z_of, float* __restrict line_of,
                              float* __restrict sample_of, float* __restrict bow_of,
                              float* __restrict clearance_of) {
    constexpr auto columns = static_cast<int>(RayTable::columns), rows = static_cast<int>(RayTable::rows);
    constexpr auto last_column = static_cast<float>(columns - 1), last_row = static_cast<float>(rows - 1);
    const auto& m = place.rows;
    const float ex = place.eye[0], ey = place.eye[1], ez = place.eye[2];
    const float ux = place.up_seen[0], uy = place.up_seen[1], uz = place.up_seen[2];
    const float near = near_end, middle = table.middle, square = table.middle * table.middle;
    int behind = 0;
    for (int i = 0; i < count; ++i) {
        const float wx = x_of[i] - ex, wy = y_of[i] - ey, wz = z_of[i] - ez;
        const float dx = m[0] * wx + m[1] * wy + m[2] * wz, dy = m[3] * wx + m[4] * wy + m[5] * wz,
                    dz = m[6] * wx + m[7] * wy + m[8] * wz;
        const float height = dx * ux + dy * uy + dz * uz;
        const float lx = dx - height * ux, ly = dy - height * uy, lz = dz - height * uz;
        const float level = std::max(std::sqrt(lx * lx + ly * ly + lz * lz), 1e-3F), over = 1 / level;
        const float u = std::sqrt(square + std::abs(height) * table.per_b) - middle;
        const float column = std::min(level * table.columns_per_metre, last_column);
        const float row = std::min(std::max((height > 0 ? -u : u) - table.first_row, 0.0F), last_row);
        const int c = std::min(static_cast<int>(column), columns - 2),
                  r = std::min(static_cast<int>(row), rows - 2);
        const float fc = column - static_cast<float>(c), fr = row - static_cast<float>(r);
        const int at = 4 * (r * columns + c), under = at + 4 * columns;
        const auto cell = [=](int k) {
            const float high = cells[at + k] + fc * (cells[at + k + 4] - cells[at + k]),
                        low = cells[under + k] + fc * (cells[under + k + 4] - cells[under + k]);
            return high + fr * (low - high);
        };
        const float turn = cell(0), longer = 1 + cell(1);
        const float q = turn * turn, s = turn - turn * q * (1 / 6.0F - q * (1 / 120.0F)),
                    v = q * (0.5F - q * (1 / 24.0F - q * (1 / 720.0F)));  // 1 - cosine
        const float along = -(v + height * s * over);
        const float outwards = longer * (1 + along),
                    upwards = longer * (level * s - height * v - along * height);
        const float x = outwards * dx + upwards * ux, y = outwards * dy + upwards * uy,
                    z = outwards * dz + upwards * uz;
        const float inverse = 1 / (z > near ? z : near);
        x_of[i] = x, y_of[i] = y, z_of[i] = z;
        line_of[i] = (x * inverse - grid.first_x) * grid.lines_per_x;
        sample_of[i] = (grid.first_y - y * inverse) * grid.samples_per_y;
        bow_of[i] = cell(2) / (outwards * level);
        if (shadows) clearance_of[i] = cell(3);
        behind += z <= near ? 1 : 0;
    }
    return behind;
}

ECHOLOOP_SIMD
int find_bent_lit(int count, const PartPlace place, const SampleGrid grid, const TablePlaces table,
                  const float* __restrict cells, float* __restrict x_of, float* __restrict y_of,
                  float* __restrict z_of, float* __restrict line_of, float* __restrict sample_of,
                  float* __restrict bow_of) {
    return find_bent<false>(count, place, grid, table, cells, x_of, y_of, z_of, line_of, sample_of, bow_of,
                            nullptr);
}

ECHOLOOP_SIMD
int find_bent_but_shadows(int count, const PartPlace place, const SampleGrid grid, const TablePlaces table,
                          const float* __restrict cells, float* __restrict x_of, float* __restrict y_of,
                          float* __restrict z_of, float* __restrict line_of, float* __restrict sample_of,
                          float* __restrict bow_of, float* __restrict clearance_of) {
    return find_bent<true>(count, place, grid, table, cells, x_of, y_of, z_of, line_of, sample_of, bow_of,
                           clearance_of);
}

}  // namespace

PartPlace::PartPlace(const View& view, const Pose& frame_from_fan, Vec3 up) {
    const Quat q = frame_from_fan.orientation * view.fan_from_view();
    const auto set = [](Vec3 v, float* to) {
        to[0] = static_cast<float>(v.x), to[1] = static_cast<float>(v.y), to[2] = static_cast<float>(v.z);
    };
    set(rotate(q, {0, -1, 0}), rows.data());
    set(rotate(q, {0, 0, 1}), rows.data() + 3);
    set(rotate(q, {1, 0, 0}), rows.data() + 6);
    set(frame_from_fan.position, eye.data());
    for (std::size_t axis = 0; axis < 3; ++axis)
        up_seen[axis] = static_cast<float>(
            dot({double{rows[3 * axis]}, double{rows[3 * axis + 1]}, double{rows[3 * axis + 2]}}, up));
}

void SeenCorners::find(std::span<const SceneVertex> vertices, const PartPlace& place, const SampleGrid& grid,
                       const RayTable* rays) {
    count_ = vertices.size();
    if (numbers_.size() < rows * count_) numbers_.resize(rows * count_);
    const auto count = static_cast<int>(count_);
    float *const x = row(0), *const y = row(1), *const z = row(2);
    for (std::size_t i = 0; i < count_; ++i) {
        const auto& position = vertices[i].position;
        x[i] = position[0], y[i] = position[1], z[i] = position[2];
    }
    int behind = 0;
    if (rays == nullptr) {
        behind = find_straight(count, place, grid, x, y, z, row(3), row(4));
    } else {
        const RayTable::Rows& places = rays->row_places();
        const float* const cells = rays->cells().data()->data();
        const TablePlaces table{static_cast<float>(1 / rays->column_step()),
                                static_cast<float>(places.a / (2 * places.b)),
                                static_cast<float>(1 / places.b), static_cast<float>(places.first)};
        behind = rays->has_shadow()
                     ? find_bent_but_shadows(count, place, grid, table, cells, x, y, z, row(3), row(4),
                                             row(5), row(6))
                     : find_bent_lit(count, place, grid, table, cells, x, y, z, row(3), row(4), row(5));
    }
    behind_ = static_cast<std::size_t>(behind);
}

}  // namespace echoloop::raster
