#include "render/scene/clusters.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "render/scene/corner_normal.h"

namespace echoloop {
namespace {

/// m; a third of the largest cell, so that no plane at a round coordinate lies between two cells of any size.
constexpr double grid_origin = 131'072.0 / 3;

/// Of the planes that hold a border against those of the surface, which are many more in a large cell.
constexpr double border_weight = 4;

struct PositionKey {
    Vec3 p;
    bool operator==(const PositionKey& other) const { return p == other.p; }
    std::size_t hash() const {
        return mix(std::bit_cast<std::uint64_t>(p.x + 0.0), std::bit_cast<std::uint64_t>(p.y + 0.0),
                   std::bit_cast<std::uint64_t>(p.z + 0.0));
    }
};

/// For every vertex the chord of the mesh's open border there, or nearly zero within the surface: the edges
/// opposite to a vertex form a closed ring around it unless it is on a border.
std::vector<Vec3> border_chords(const Mesh& mesh, std::span<const std::uint32_t> indices) {
    Numbering<PositionKey> number(mesh.positions.size());
    std::vector<std::uint32_t> welded;
    welded.reserve(mesh.positions.size());
    for (const Vec3& p : mesh.positions) welded.push_back(number({p}));
    std::vector<Vec3> chord(number.keys().size()), out;
    for (std::size_t i = 0; i < indices.size(); i += 3)
        for (std::size_t k = 0; k < 3; ++k) {
            Vec3& sum = chord[welded[indices[i + k]]];
            sum = sum + (mesh.positions[indices[i + (k + 2) % 3]] - mesh.positions[indices[i + (k + 1) % 3]]);
        }
    out.reserve(welded.size());
    for (const std::uint32_t i : welded) out.push_back(chord[i]);
    return out;
}

Vec3 middle_of(const Mesh& mesh) {
    Vec3 low = mesh.positions.front(), high = low;
    for (const Vec3& p : mesh.positions) {
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    return 0.5 * (low + high);
}

/// Which of the six directions along the axes is nearest.
std::uint32_t nearest_side(Vec3 n) {
    const double x = std::abs(n.x), y = std::abs(n.y), z = std::abs(n.z);
    if (z >= x && z >= y) return n.z < 0 ? 5 : 4;
    if (y >= x) return n.y < 0 ? 3 : 2;
    return n.x < 0 ? 1 : 0;
}

}  // namespace

Vec3 MergedPlace::position(double width) const {
    const Vec3 mean = (1 / area) * moment, best = planes.lowest_near(mean), off = best - mean;
    const bool near =
        std::max({std::abs(off.x), std::abs(off.y), std::abs(off.z)}) <= std::max(width, std::sqrt(area));
    return near ? best : mean;
}

MeanNormal NormalSum::mean() const {
    const double length = norm(sum), mean = length / area;
    return {length > 0 ? (1 / length) * sum : Vec3{},
            static_cast<float>(std::clamp(1 - mean * mean, 0.0, 1.0))};
}

std::uint32_t Clusters::shade_in(std::uint32_t place, std::uint32_t side) {
    std::uint32_t& shade = places_[place].shade[side];
    if (shade == 0) {
        shades_.push_back({place, side, {}});
        shade = static_cast<std::uint32_t>(shades_.size());
    }
    return shade - 1;
}

std::array<std::uint32_t, 3> Clusters::corners_of(const Mesh& mesh, const std::uint32_t* corners,
                                                  const Vec3* borders,
                                                  std::span<const std::uint32_t> cell_of) {
    std::array<std::uint32_t, 3> out{};
    const Vec3 doubled = doubled_area(mesh, corners);
    const double length = norm(doubled), area = length / 6;  // a third for each corner
    const Vec3 face = (1 / length) * doubled;
    Quadric planes;
    planes.add_plane(face, dot(face, mesh.positions[corners[0]] - middle_), area);
    for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 from_middle = mesh.positions[corners[k]] - middle_;
        const std::uint32_t index = cell_of[corners[k]];
        MergedPlace& place = places_[index].merged;
        place.planes.add(planes);
        const Vec3 across = cross(borders[corners[k]], face);
        const double square = dot(across, across);
        if (square > 1e-12 * area) {
            const double chord = std::sqrt(square);
            place.planes.add_plane((1 / chord) * across, dot(across, from_middle) / chord,
                                   border_weight * area);
        }
        place.moment = place.moment + area * from_middle;
        place.area += area;
        const Vec3 normal = corner_normal(mesh, corners[k], face).normal;
        out[k] = shade_in(index, nearest_side(normal));
        shades_[out[k]].normals.add({area * normal, area});
    }
    return out;
}

Vec3 Clusters::position(std::uint32_t vertex) const {
    return middle_ + places_[place_of(vertex)].merged.position(cell_);
}

double Clusters::error(std::uint32_t vertex) const {
    const MergedPlace& merged = places_[place_of(vertex)].merged;
    return merged.error(merged.position(cell_));
}

void Clusters::add_triangle(const MergedTriangle& triangle) {
    const auto place = [&](std::size_t k) { return place_of(triangle.corners[k]); };
    if (place(0) != place(1) && place(1) != place(2) && place(2) != place(0)) triangles_.push_back(triangle);
}

/// Of each vertex in use the number of its cell, in the order of the indices; as many places as cells.
std::vector<std::uint32_t> Clusters::number_cells(const Mesh& mesh, std::span<const std::uint32_t> indices) {
    constexpr std::uint32_t none = ~0U;
    std::vector<std::uint32_t> out(mesh.positions.size(), none);
    Numbering<Cell> cells(indices.size() / 20);
    const auto tick = [&](double v) {
        return static_cast<std::int32_t>(std::floor((v + grid_origin) / cell_));
    };
    for (const std::uint32_t corner : indices)
        if (const Vec3& p = mesh.positions[corner]; out[corner] == none)
            out[corner] = cells({tick(p.x), tick(p.y), tick(p.z)});
    places_.resize(cells.keys().size());
    return out;
}

Clusters::Clusters(const Mesh& mesh, std::span<const std::uint32_t> indices, int exponent,
                   std::vector<std::uint32_t>* place_of_corner)
    : cell_(std::ldexp(1.0, exponent)), middle_(middle_of(mesh)) {
    const auto borders = border_chords(mesh, indices);
    const auto cell_of = number_cells(mesh, indices);
    for (std::size_t i = 0; i < indices.size(); i += 3) {
        const auto corners = corners_of(mesh, &indices[i], borders.data(), cell_of);
        add_triangle({static_cast<std::uint32_t>(i / 3), corners});
        if (place_of_corner != nullptr)
            for (const std::uint32_t corner : corners) place_of_corner->push_back(place_of(corner));
    }
}

}  // namespace echoloop
