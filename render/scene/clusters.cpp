#include "render/scene/clusters.h"

#include <algorithm>
#include <cmath>

#include "render/scene/corner_normal.h"
#include "render/scene/welding.h"

namespace echoloop {
namespace {

/// m; a third of the largest cell, so that no plane at a round coordinate, a multiple of 2^-n m, lies between
/// two cells of any size.
constexpr double grid_origin = 131'072.0 / 3;

/// Of the planes that hold a border against those of the surface, which are many more in a large cell.
constexpr double border_weight = 4;

/// Of a mesh's places, among threads.
constexpr std::size_t cluster_shares = 4;

/// For every vertex the chord of the mesh's open border there, or nearly zero within the surface: the edges
/// opposite to a vertex form a closed ring around it unless it is on a border.
std::vector<Vec3> border_chords(const Mesh& mesh, std::span<const std::uint32_t> indices, MeshLoops& loops) {
    const auto place = welded(mesh.positions, loops);
    std::vector<Vec3> chord(place.size());
    loops.parts(cluster_shares, [&](std::size_t share) {
        const Share own(share, cluster_shares, place.size());
        for (std::size_t i = 0; i < indices.size(); i += 3)
            for (std::size_t k = 0; k < 3; ++k) {
                const std::uint32_t at = place[indices[i + k]];
                if (!own.has(at)) continue;
                const Vec3 &from = mesh.positions[indices[i + (k + 1) % 3]],
                           &to = mesh.positions[indices[i + (k + 2) % 3]];
                chord[at] = chord[at] + (to - from);
            }
    });
    loops.each(place.size(), [&](std::size_t i) {
        if (place[i] != i) chord[i] = chord[place[i]];
    });
    return chord;
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

std::uint32_t Clusters::shade_in(std::uint32_t place, std::uint32_t side, std::vector<Shade>& shades) {
    std::uint32_t& shade = places_[place].shade[side];
    if (shade == 0) {
        shades.push_back({place, side, {}});
        shade = static_cast<std::uint32_t>(shades.size());
    }
    return shade - 1;
}

struct Clusters::Corner {
    Vec3 position, border, face;
    Quadric plane;  ///< of the triangle
    double area;    ///< m^2, a third of the triangle's
    Vec3 normal;
};

/// Returns the vertex, among `shades`.
std::uint32_t Clusters::add_corner(const Corner& corner, std::uint32_t index, std::vector<Shade>& shades) {
    MergedPlace& place = places_[index].merged;
    place.planes.add(corner.plane);
    const Vec3 across = cross(corner.border, corner.face);
    const double square = dot(across, across);
    if (square > 1e-12 * corner.area) {
        const double chord = std::sqrt(square);
        place.planes.add_plane((1 / chord) * across, dot(across, corner.position) / chord,
                               border_weight * corner.area);
    }
    place.moment = place.moment + corner.area * corner.position;
    place.area += corner.area;
    const std::uint32_t shade = shade_in(index, nearest_side(corner.normal), shades);
    shades[shade].normals.add({corner.area * corner.normal, corner.area});
    return shade;
}

/// Merges corners into one share of the places, and puts their vertices into the triangles.
void Clusters::add_share(std::size_t share, const Mesh& mesh, std::span<const std::uint32_t> indices,
                         std::span<const Vec3> borders, std::span<const std::uint32_t> cell_of,
                         std::vector<Shade>& shades) {
    const Share own(share, cluster_shares, places_.size());
    const auto is_own = [&](std::uint32_t vertex) { return own.has(cell_of[vertex]); };
    auto left = triangles_.begin();
    for (std::size_t i = 0; i < indices.size(); i += 3) {
        const std::uint32_t* const corners = &indices[i];
        const bool is_left = left != triangles_.end() && left->number == i / 3;
        if (is_own(corners[0]) || is_own(corners[1]) || is_own(corners[2])) {
            const Vec3 doubled = doubled_area(mesh, corners);
            const double length = norm(doubled);
            Corner corner;
            corner.area = length / 6;
            corner.face = (1 / length) * doubled;
            corner.plane.add_plane(corner.face, dot(corner.face, mesh.positions[corners[0]] - middle_),
                                   corner.area);
            for (std::size_t k = 0; k < 3; ++k) {
                if (!is_own(corners[k])) continue;
                corner.position = mesh.positions[corners[k]] - middle_;
                corner.border = borders[corners[k]];
                corner.normal = corner_normal(mesh, corners[k], corner.face).normal;
                const std::uint32_t vertex = add_corner(corner, cell_of[corners[k]], shades);
                if (is_left) left->corners[k] = vertex;
            }
        }
        if (is_left) ++left;
    }
}

Vec3 Clusters::position(std::uint32_t vertex) const {
    return middle_ + places_[place_of(vertex)].merged.position(cell_);
}

double Clusters::error(std::uint32_t vertex) const {
    const MergedPlace& merged = places_[place_of(vertex)].merged;
    return merged.error(merged.position(cell_));
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

/// Those that are left, without their corners.
void Clusters::list_triangles(std::span<const std::uint32_t> indices,
                              std::span<const std::uint32_t> cell_of) {
    for (std::size_t i = 0; i < indices.size(); i += 3) {
        const std::uint32_t a = cell_of[indices[i]], b = cell_of[indices[i + 1]], c = cell_of[indices[i + 2]];
        if (a != b && b != c && c != a) triangles_.push_back({static_cast<std::uint32_t>(i / 3), {}});
    }
}

Clusters::Clusters(const Mesh& mesh, std::span<const std::uint32_t> indices, double cell,
                   std::vector<std::uint32_t>* place_of_corner)
    : cell_(cell), middle_(middle_of(mesh)) {
    MeshLoops loops(indices.size() / 3);
    const auto borders = border_chords(mesh, indices, loops);
    const auto cell_of = number_cells(mesh, indices);
    list_triangles(indices, cell_of);
    std::array<std::vector<Shade>, cluster_shares> shades;
    loops.parts(cluster_shares,
                [&](std::size_t share) { add_share(share, mesh, indices, borders, cell_of, shades[share]); });
    std::vector<std::uint32_t> first;  // of a place's share
    for (std::size_t share = 0; share < cluster_shares; ++share) {
        const Share own(share, cluster_shares, places_.size());
        first.insert(first.end(), own.last - own.first, static_cast<std::uint32_t>(shades_.size()));
        shades_.insert(shades_.end(), shades[share].begin(), shades[share].end());
    }
    for (MergedTriangle& triangle : triangles_)
        for (std::size_t k = 0; k < 3; ++k)
            triangle.corners[k] += first[cell_of[indices[3 * std::size_t{triangle.number} + k]]];
    if (place_of_corner == nullptr) return;
    place_of_corner->reserve(indices.size());
    for (const std::uint32_t vertex : indices) place_of_corner->push_back(cell_of[vertex]);
}

}  // namespace echoloop
