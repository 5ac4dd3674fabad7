#include "render/raster/seen_corners.h"

#include <algorithm>
#include <cmath>

#include "render/simd.h"

namespace echoloop::raster {
namespace {

/// Where a point that lies there from us is seen.
struct Seen {
    float line, sample;
};

ECHOLOOP_INLINE Seen seen_at(const SampleGrid& grid, float x, float y, float z) {
    const float inverse = 1 / std::max(z, near_end);
    return {(x * inverse - grid.first_x) * grid.lines_per_x,
            (grid.first_y - y * inverse) * grid.samples_per_y};
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

/// What a RayTable says of points: its cells, and where a point is among them.
struct TablePlaces {
    const float* cells;
    float columns_per_metre, middle, per_b, first_row;
};

/// As gl/fan_shader's bent_vertex_shader, in the frame of the part until the end.
ECHOLOOP_SIMD
int find_bent(const SceneVertex* __restrict vertices, int count, const PartPlace place, const SampleGrid grid,
              const TablePlaces table, float* __restrict x_of, float* __restrict y_of, float* __restrict z_of,
              float* __restrict line_of, float* __restrict sample_of, float* __restrict nx_of,
              float* __restrict ny_of, float* __restrict nz_of, float* __restrict clearance_of) {
    constexpr auto columns = static_cast<int>(RayTable::columns), rows = static_cast<int>(RayTable::rows);
    constexpr auto last_column = static_cast<float>(columns - 1), last_row = static_cast<float>(rows - 1);
    const auto& m = place.rows;
    const float ux = place.up[0], uy = place.up[1], uz = place.up[2];
    int behind = 0;
    for (int i = 0; i < count; ++i) {
        const float dx = vertices[i].position[0] - place.eye[0], dy = vertices[i].position[1] - place.eye[1],
                    dz = vertices[i].position[2] - place.eye[2];
        const float height = dx * ux + dy * uy + dz * uz;
        const float lx = dx - height * ux, ly = dy - height * uy, lz = dz - height * uz;
        const float level = std::sqrt(lx * lx + ly * ly + lz * lz), over = 1 / std::max(level, 1e-6F);
        const float ax = lx * over, ay = ly * over, az = lz * over;
        const float u =
            std::sqrt(table.middle * table.middle + std::abs(height) * table.per_b) - table.middle;
        const float column = std::min(level * table.columns_per_metre, last_column);
        const float row = std::min(std::max((height > 0 ? -u : u) - table.first_row, 0.0F), last_row);
        const int c = std::min(static_cast<int>(column), columns - 2),
                  r = std::min(static_cast<int>(row), rows - 2);
        const float fc = column - static_cast<float>(c), fr = row - static_cast<float>(r);
        const float* upper = table.cells + 4 * (r * columns + c);
        const auto cell = [&](int k) {
            const float high = upper[k] + fc * (upper[k + 4] - upper[k]),
                        low = upper[k + 4 * columns] +
                              fc * (upper[k + 4 * columns + 4] - upper[k + 4 * columns]);
            return high + fr * (low - high);
        };
        const float turn = cell(0), stretch = cell(1), bow = cell(2), clearance = cell(3);
        const float q = turn * turn, s = turn - turn * q * (1 / 6.0F - q * (1 / 120.0F)),
                    v = q * (0.5F - q * (1 / 24.0F - q * (1 / 720.0F)));  // 1 - cosine
        const float ahead = -(level * v + height * s), upwards = level * s - height * v, longer = 1 + stretch;
        const float px = longer * (dx + ahead * ax + upwards * ux),
                    py = longer * (dy + ahead * ay + upwards * uy),
                    pz = longer * (dz + ahead * az + upwards * uz);
        const float bq = bow * bow, bs = bow - bow * bq * (1 / 6.0F - bq * (1 / 120.0F)),
                    bv = bq * (0.5F - bq * (1 / 24.0F - bq * (1 / 720.0F)));
        const float ox = vertices[i].normal[0], oy = vertices[i].normal[1], oz = vertices[i].normal[2];
        const float n_ahead = ox * ax + oy * ay + oz * az, n_up = ox * ux + oy * uy + oz * uz;
        const float more_ahead = n_up * bs - n_ahead * bv, more_up = -(n_up * bv + n_ahead * bs);
        const float nx = ox + more_ahead * ax + more_up * ux, ny = oy + more_ahead * ay + more_up * uy,
                    nz = oz + more_ahead * az + more_up * uz;
        const float x = m[0] * px + m[1] * py + m[2] * pz, y = m[3] * px + m[4] * py + m[5] * pz,
                    z = m[6] * px + m[7] * py + m[8] * pz;
        const Seen at = seen_at(grid, x, y, z);
        x_of[i] = x, y_of[i] = y, z_of[i] = z, line_of[i] = at.line, sample_of[i] = at.sample;
        nx_of[i] = m[0] * nx + m[1] * ny + m[2] * nz;
        ny_of[i] = m[3] * nx + m[4] * ny + m[5] * nz;
        nz_of[i] = m[6] * nx + m[7] * ny + m[8] * nz;
        clearance_of[i] = clearance;
        behind += z <= near_end ? 1 : 0;
    }
    return behind;
}

}  // namespace

PartPlace::PartPlace(const View& view, const Pose& frame_from_fan, Vec3 up_of_world) {
    const Quat q = frame_from_fan.orientation * view.fan_from_view();
    const auto set = [](Vec3 v, float* to) {
        to[0] = static_cast<float>(v.x), to[1] = static_cast<float>(v.y), to[2] = static_cast<float>(v.z);
    };
    set(rotate(q, {0, -1, 0}), rows.data());
    set(rotate(q, {0, 0, 1}), rows.data() + 3);
    set(rotate(q, {1, 0, 0}), rows.data() + 6);
    set(frame_from_fan.position, eye.data());
    set(up_of_world, up.data());
}

void SeenCorners::find(std::span<const SceneVertex> vertices, const PartPlace& place, const SampleGrid& grid,
                       const RayTable* rays) {
    count_ = vertices.size();
    if (numbers_.size() < rows * count_) numbers_.resize(rows * count_);
    const auto count = static_cast<int>(count_);
    int behind = 0;
    if (rays == nullptr) {
        float *const x = row(0), *const y = row(1), *const z = row(2);
        for (std::size_t i = 0; i < count_; ++i) {
            const auto& position = vertices[i].position;
            x[i] = position[0], y[i] = position[1], z[i] = position[2];
        }
        behind = find_straight(count, place, grid, x, y, z, row(3), row(4));
    } else {
        const RayTable::Rows& places = rays->row_places();
        const TablePlaces table{rays->cells().data()->data(), static_cast<float>(1 / rays->column_step()),
                                static_cast<float>(places.a / (2 * places.b)),
                                static_cast<float>(1 / places.b), static_cast<float>(places.first)};
        behind = find_bent(vertices.data(), count, place, grid, table, row(0), row(1), row(2), row(3), row(4),
                           row(5), row(6), row(7), row(8));
    }
    behind_ = static_cast<std::size_t>(behind);
}

}  // namespace echoloop::raster
