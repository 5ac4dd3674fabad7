#include "render/raster/seen_corners.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "render/simd.h"

namespace echoloop::raster {
namespace {

/// Rows of what vertices have of each coordinate.
void unpack_positions(std::span<const SceneVertex> vertices, float* x, float* y, float* z) {
    const auto position = [&](std::size_t i) {
        Four all;  // the normal's first number, too
        std::memcpy(&all, &vertices[i], sizeof all);
        return all;
    };
    std::size_t i = 0;
    for (; i + 4 <= vertices.size(); i += 4) {
        const Four a = position(i), b = position(i + 1), c = position(i + 2), d = position(i + 3);
        const Four xy_ab = __builtin_shufflevector(a, b, 0, 4, 1, 5),
                   xy_cd = __builtin_shufflevector(c, d, 0, 4, 1, 5),
                   z_ab = __builtin_shufflevector(a, b, 2, 6, 2, 6),
                   z_cd = __builtin_shufflevector(c, d, 2, 6, 2, 6);
        const Four xs = __builtin_shufflevector(xy_ab, xy_cd, 0, 1, 4, 5),
                   ys = __builtin_shufflevector(xy_ab, xy_cd, 2, 3, 6, 7),
                   zs = __builtin_shufflevector(z_ab, z_cd, 0, 1, 4, 5);
        std::memcpy(x + i, &xs, sizeof xs), std::memcpy(y + i, &ys, sizeof ys);
        std::memcpy(z + i, &zs, sizeof zs);
    }
    for (; i < vertices.size(); ++i)
        x[i] = vertices[i].position[0], y[i] = vertices[i].position[1], z[i] = vertices[i].position[2];
}

/// From positions that are there already. Returns how many are not in front of the near end.
ECHOLOOP_SIMD
int find_straight(int count, const PartPlace place, const SampleGrid grid, float* __restrict x_of,
                  float* __restrict y_of, float* __restrict z_of, float* __restrict line_of,
                  float* __restrict sample_of) {
    const auto& m = place.rows;
    const float ex = place.eye[0], ey = place.eye[1], ez = place.eye[2];
    const float near = near_end;
    int behind = 0;
    for (int i = 0; i < count / whole_vector * whole_vector; ++i) {
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

/// How points lie to us in the view's axes, from their positions, and how high above; and among a table's
/// cells: the first of the four around each, and the shares of the next column and of the next row.
ECHOLOOP_SIMD
void find_places(int count, const PartPlace place, const TablePlaces table, float* __restrict x_of,
                 float* __restrict y_of, float* __restrict z_of, float* __restrict height_of,
                 std::int32_t* __restrict cell_of, float* __restrict column_share,
                 float* __restrict row_share) {
    constexpr auto columns = static_cast<int>(RayTable::columns), rows = static_cast<int>(RayTable::rows);
    constexpr auto last_column = static_cast<float>(columns - 1), last_row = static_cast<float>(rows - 1);
    const auto& m = place.rows;
    const float ex = place.eye[0], ey = place.eye[1], ez = place.eye[2];
    const float ux = place.up_seen[0], uy = place.up_seen[1], uz = place.up_seen[2];
    const float middle = table.middle, square = table.middle * table.middle;
    for (int i = 0; i < count / whole_vector * whole_vector; ++i) {
        const float wx = x_of[i] - ex, wy = y_of[i] - ey, wz = z_of[i] - ez;
        const float x = m[0] * wx + m[1] * wy + m[2] * wz, y = m[3] * wx + m[4] * wy + m[5] * wz,
                    z = m[6] * wx + m[7] * wy + m[8] * wz;
        const float height = x * ux + y * uy + z * uz;
        const float lx = x - height * ux, ly = y - height * uy, lz = z - height * uz;
        const float level = std::sqrt(lx * lx + ly * ly + lz * lz);
        const float u = std::sqrt(square + std::abs(height) * table.per_b) - middle;
        const float column = std::min(level * table.columns_per_metre, last_column);
        const float row = std::min(std::max((height > 0 ? -u : u) - table.first_row, 0.0F), last_row);
        const int c = std::min(static_cast<int>(column), columns - 2),
                  r = std::min(static_cast<int>(row), rows - 2);
        x_of[i] = x, y_of[i] = y, z_of[i] = z;
        height_of[i] = height;
        cell_of[i] = r * columns + c;
        column_share[i] = column - static_cast<float>(c), row_share[i] = row - static_cast<float>(r);
    }
}

/// What a table says of each: all four numbers of a cell at once, since a processor gathers them one by one.
ECHOLOOP_SIMD
void look_up(int count, const float* __restrict cells, const std::int32_t* __restrict cell_of,
             const float* __restrict column_share, const float* __restrict row_share,
             float* __restrict moves) {
    using Eight = float __attribute__((vector_size(32)));
    constexpr std::size_t next_row = 4 * RayTable::columns;
    for (int i = 0; i < count; ++i) {
        const float* const at = cells + 4 * static_cast<std::size_t>(cell_of[i]);
        Eight both, below;  // the cell and the next one of the row
        std::memcpy(&both, at, sizeof both), std::memcpy(&below, at + next_row, sizeof below);
        both += row_share[i] * (below - both);
        const Four left = __builtin_shufflevector(both, both, 0, 1, 2, 3),
                   right = __builtin_shufflevector(both, both, 4, 5, 6, 7);
        const Four move = left + column_share[i] * (right - left);
        std::memcpy(moves + 4 * static_cast<std::size_t>(i), &move, sizeof move);
    }
}

/// As RayTable::Move says. Returns how many are not in
/// front of the near end.
ECHOLOOP_SIMD
int bend(int count, const float* __restrict moves, const std::array<float, 3> up, const SampleGrid grid,
         float* __restrict x_of, float* __restrict y_of, float* __restrict z_of, float* __restrict line_of,
         float* __restrict sample_of, float* __restrict height_and_bow, float* __restrict clearance_of) {
    const float ux = up[0], uy = up[1], uz = up[2], near = near_end;
    int behind = 0;
    for (int i = 0; i < count / whole_vector * whole_vector; ++i) {
        const float outwards = moves[4 * i], rise = moves[4 * i + 1], bow = moves[4 * i + 2],
                    clearance = moves[4 * i + 3];
        const float longer = 1 + outwards, upwards = rise - outwards * height_and_bow[i];
        const float x = longer * x_of[i] + upwards * ux, y = longer * y_of[i] + upwards * uy,
                    z = longer * z_of[i] + upwards * uz;
        const float inverse = 1 / (z > near ? z : near);
        x_of[i] = x, y_of[i] = y, z_of[i] = z;
        line_of[i] = (x * inverse - grid.first_x) * grid.lines_per_x;
        sample_of[i] = (grid.first_y - y * inverse) * grid.samples_per_y;
        height_and_bow[i] = bow, clearance_of[i] = clearance;
        behind += z <= near ? 1 : 0;
    }
    return behind;
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
    count_ = vertices.size(), stride_ = padded(count_), behind_ = 0;
    if (count_ == 0) return;
    if (numbers_.size() < rows * stride_) numbers_.resize(rows * stride_);
    const auto count = static_cast<int>(stride_);
    float *const x = row(0), *const y = row(1), *const z = row(2);
    unpack_positions(vertices, x, y, z);
    for (float* const coordinate : {x, y, z})
        std::fill(coordinate + count_, coordinate + stride_, coordinate[count_ - 1]);
    int behind = 0;
    if (rays == nullptr) {
        behind = find_straight(count, place, grid, x, y, z, row(3), row(4));
    } else {
        if (cells_.size() < stride_) cells_.resize(stride_), moves_.resize(4 * stride_);
        const RayTable::Rows& places = rays->row_places();
        const TablePlaces table{static_cast<float>(1 / rays->column_step()),
                                static_cast<float>(places.a / (2 * places.b)),
                                static_cast<float>(1 / places.b), static_cast<float>(places.first)};
        float *const column_share = row(3), *const row_share = row(4);
        find_places(count, place, table, x, y, z, row(5), cells_.data(), column_share, row_share);
        look_up(static_cast<int>(count_), &rays->moves().data()->outwards, cells_.data(), column_share,
                row_share, moves_.data());
        for (std::size_t i = count_; i < stride_; ++i)
            std::copy_n(&moves_[4 * (count_ - 1)], 4, &moves_[4 * i]);
        behind = bend(count, moves_.data(), place.up_seen, grid, x, y, z, row(3), row(4), row(5), row(6));
    }
    if (z[count_ - 1] <= near_end) behind -= static_cast<int>(stride_ - count_);
    behind_ = static_cast<std::size_t>(behind);
}

}  // namespace echoloop::raster
