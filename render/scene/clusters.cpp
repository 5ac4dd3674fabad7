#include "render/scene/clusters.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "render/scene/corner_normal.h"
#include "render/scene/mesh_loops.h"

namespace echoloop {
namespace {

/// m; a third of the largest cell, so that no plane at a round coordinate, a multiple of 2^-n m, lies between
/// two cells of any size.
constexpr double grid_origin = 131'072.0 / 3;

/// Of the planes that hold a border against those of the surface, which are many more in a large cell.
constexpr double border_weight = 4;

/// Of a mesh's places, among threads.
constexpr std::size_t cluster_shares = 4;
/// Of its triangles, while their places get numbers.
constexpr std::size_t numbering_shares = 8;

/// For every vertex the chord of the mesh's open border there, or nearly zero within the surface: the edges
/// opposite to a vertex form a closed ring around it unless it is on a border.
std::vector<Vec3> border_chords(const Mesh& mesh, std::span<const std::uint32_t> place,
                                std::span<const std::uint32_t> indices, MeshLoops& loops) {
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
                         std::span<const Vec3> borders, std::span<const std::uint32_t> cell_of_corner,
                         std::vector<Shade>& shades) {
    const Share own(share, cluster_shares, places_.size());
    auto left = triangles_.begin();
    for (std::size_t i = 0; i < indices.size(); i += 3) {
        const std::uint32_t *const corners = &indices[i], *const cells = &cell_of_corner[i];
        const bool is_left = left != triangles_.end() && left->number == i / 3;
        if (own.has(cells[0]) || own.has(cells[1]) || own.has(cells[2])) {
            const Vec3 doubled = doubled_area(mesh, corners);
            const double length = norm(doubled);
            Corner corner;
            corner.area = length / 6;
            corner.face = (1 / length) * doubled;
            corner.plane.add_plane(corner.face, dot(corner.face, mesh.positions[corners[0]] - middle_),
                                   corner.area);
            for (std::size_t k = 0; k < 3; ++k) {
                if (!own.has(cells[k])) continue;
                corner.position = mesh.positions[corners[k]] - middle_;
                corner.border = borders[corners[k]];
                corner.normal = corner_normal(mesh, corners[k], corner.face).normal;
                const std::uint32_t vertex = add_corner(corner, cells[k], shades);
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

/// Of each corner the number of its cell, in the order of the indices; as many places as cells, and the
/// triangles that are left, without their corners. Each share of the triangles numbers its own cells first.
void Clusters::number_cells(const Mesh& mesh, std::span<const std::uint32_t> indices, MeshLoops& loops,
                            std::span<std::uint32_t> cell_of_corner) {
    Scratch<Cell> cell_of(mesh.positions.size());
    loops.each(cell_of.size(), [&](std::size_t i) {
        const auto tick = [&](double v) {
            return static_cast<std::int32_t>(std::floor((v + grid_origin) / cell_));
        };
        const Vec3& p = mesh.positions[i];
        cell_of[i] = {tick(p.x), tick(p.y), tick(p.z)};
    });
    struct Numbered {
        Numbering<Cell> cells;
        std::vector<MergedTriangle> left;
        std::vector<std::uint32_t> of_all;  ///< number of each cell
    };
    std::array<Numbered, numbering_shares> numbered;
    const auto share_of = [&](std::size_t share) {
        return Share(share, numbering_shares, indices.size() / 3);
    };
    loops.parts(numbering_shares, [&](std::size_t number) {
        constexpr std::size_t known = 4096;  // vertices: those of neighbouring triangles
        std::vector<std::array<std::uint32_t, 2>> last(known, {~0U, 0});
        Numbered& own = numbered[number];
        for (std::uint32_t t = share_of(number).first; t < share_of(number).last; ++t) {
            std::uint32_t* const cells = &cell_of_corner[std::size_t{3} * t];
            for (std::size_t k = 0; k < 3; ++k) {
                const std::uint32_t vertex = indices[std::size_t{3} * t + k];
                auto& [same, cell] = last[vertex % known];
                if (same != vertex) same = vertex, cell = own.cells(cell_of[vertex]);
                cells[k] = cell;
            }
            if (cells[0] != cells[1] && cells[1] != cells[2] && cells[2] != cells[0])
                own.left.push_back({t, {}});
        }
    });
    Numbering<Cell> all(indices.size() / 20);
    for (Numbered& own : numbered) {
        for (const Cell& cell : own.cells.keys()) own.of_all.push_back(all(cell));
        triangles_.insert(triangles_.end(), own.left.begin(), own.left.end());
    }
    loops.parts(numbering_shares, [&](std::size_t number) {
        const Share own = share_of(number);
        for (std::size_t i = std::size_t{3} * own.first; i < std::size_t{3} * own.last; ++i)
            cell_of_corner[i] = numbered[number].of_all[cell_of_corner[i]];
    });
    places_.resize(all.keys().size());
}

Clusters::Clusters(const Mesh& mesh, std::span<const std::uint32_t> places,
                   std::span<const std::uint32_t> indices, double cell,
                   Scratch<std::uint32_t>* place_of_corner)
    : cell_(cell), middle_(middle_of(mesh)) {
    MeshLoops loops(indices.size() / 3);
    const auto borders = border_chords(mesh, places, indices, loops);
    std::optional<Scratch<std::uint32_t>> unwanted;
    if (place_of_corner == nullptr) place_of_corner = &unwanted.emplace(indices.size());
    const auto cell_of_corner = place_of_corner->all();
    number_cells(mesh, indices, loops, cell_of_corner);
    std::array<std::vector<Shade>, cluster_shares> shades;
    loops.parts(cluster_shares, [&](std::size_t share) {
        add_share(share, mesh, indices, borders, cell_of_corner, shades[share]);
    });
    std::vector<std::uint32_t> first;  // of a place's share
    for (std::size_t share = 0; share < cluster_shares; ++share) {
        const Share own(share, cluster_shares, places_.size());
        first.insert(first.end(), own.last - own.first, static_cast<std::uint32_t>(shades_.size()));
        shades_.insert(shades_.end(), shades[share].begin(), shades[share].end());
    }
    for (MergedTriangle& triangle : triangles_)
        for (std::size_t k = 0; k < 3; ++k)
            triangle.corners[k] += first[cell_of_corner[3 * std::size_t{triangle.number} + k]];
}

}  // namespace echoloop
