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
std::uint32_t side_of(Vec3 n) {
    const double x = std::abs(n.x), y = std::abs(n.y), z = std::abs(n.z);
    if (z >= x && z >= y) return n.z < 0 ? 5 : 4;
    if (y >= x) return n.y < 0 ? 3 : 2;
    return n.x < 0 ? 1 : 0;
}

}  // namespace

std::uint32_t Clusters::place_in(Numbering<Cell>& cells, Cell cell) {
    const std::uint32_t place = cells(cell);
    if (place == places_.size()) places_.emplace_back().cell = cell;
    return place;
}

std::uint32_t Clusters::shade_in(std::uint32_t place, std::uint32_t side) {
    std::uint32_t& shade = places_[place].shade[side];
    if (shade == 0) {
        shades_.push_back({place, side, {}, 0, {}, 0});
        shade = static_cast<std::uint32_t>(shades_.size());
    }
    return shade - 1;
}

void Clusters::add_triangle(const Mesh& mesh, const std::uint32_t* corners, const Vec3* borders,
                            Numbering<Cell>& cells) {
    const Vec3 doubled = doubled_area(mesh, corners);
    const double length = norm(doubled), area = length / 6;  // a third for each corner
    const Vec3 face = (1 / length) * doubled;
    for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 p = mesh.positions[corners[k]], from_middle = p - middle_;
        const auto tick = [&](double v) {
            return static_cast<std::int32_t>(std::floor((v + grid_origin) / cell_));
        };
        const std::uint32_t index = place_in(cells, {tick(p.x), tick(p.y), tick(p.z)});
        Place& place = places_[index];
        place.planes.add_plane(face, dot(face, from_middle), area);
        const Vec3 across = cross(borders[corners[k]], face);
        const double chord = norm(across);
        if (chord > 1e-6 * std::sqrt(area))
            place.planes.add_plane((1 / chord) * across, dot(across, from_middle) / chord,
                                   border_weight * area);
        place.moment = place.moment + area * from_middle;
        place.area += area;
        const Vec3 normal = corner_normal(mesh, corners[k], face).normal;
        const std::uint32_t vertex = shade_in(index, side_of(normal));
        shades_[vertex].sum = shades_[vertex].sum + area * normal;
        shades_[vertex].area += area;
        vertex_of_corner_.push_back(vertex);
    }
}

Clusters::Clusters(const Mesh& mesh, std::span<const std::uint32_t> indices, int exponent)
    : cell_(std::ldexp(1.0, exponent)), exponent_(exponent), middle_(middle_of(mesh)) {
    const auto borders = border_chords(mesh, indices);
    Numbering<Cell> cells(indices.size() / 20);
    vertex_of_corner_.reserve(indices.size());
    for (std::size_t i = 0; i < indices.size(); i += 3)
        add_triangle(mesh, &indices[i], borders.data(), cells);
    settle();
}

Clusters::Clusters(Clusters&& finer, int exponent)
    : cell_(std::ldexp(1.0, exponent)),
      exponent_(exponent),
      middle_(finer.middle_),
      vertex_of_corner_(std::move(finer.vertex_of_corner_)) {
    const int shift = exponent - finer.exponent_;
    Numbering<Cell> cells(finer.places_.size() / 3);
    std::vector<std::uint32_t> place_of, vertex_of;
    for (const Place& fine : finer.places_) {
        place_of.push_back(
            place_in(cells, {fine.cell.x >> shift, fine.cell.y >> shift, fine.cell.z >> shift}));
        Place& place = places_[place_of.back()];
        place.planes.add(fine.planes);
        place.moment = place.moment + fine.moment;
        place.area += fine.area;
    }
    for (const Shade& fine : finer.shades_) {
        vertex_of.push_back(shade_in(place_of[fine.place], fine.side));
        Shade& shade = shades_[vertex_of.back()];
        shade.sum = shade.sum + fine.sum;
        shade.area += fine.area;
    }
    for (std::uint32_t& vertex : vertex_of_corner_) vertex = vertex_of[vertex];
    settle();
}

void Clusters::settle() {
    for (Place& place : places_) {
        const Vec3 mean = (1 / place.area) * place.moment, best = place.planes.lowest_near(mean),
                   off = best - mean;
        const bool near = std::max({std::abs(off.x), std::abs(off.y), std::abs(off.z)}) <= cell_;
        const Vec3 chosen = near ? best : mean;
        place.position = middle_ + chosen;
        place.error = 2 * place.planes.rms(chosen);  // at most, on a surface of constant curvature
    }
    for (Shade& shade : shades_) {
        const double length = norm(shade.sum);
        if (length > 0) shade.normal = (1 / length) * shade.sum;
        const double spread =
            length > 0 ? 1 - length / shade.area : 1;  // normals that differ within the cell
        places_[shade.place].error = std::max(places_[shade.place].error, spread * cell_);
    }
    measure_roughness();
}

/// The variance of the normals within the cell, and once more what of it goes on from cell to cell: facets
/// between the middles of cells reach over twice as much as a cell. Where normals change linearly by g per
/// metre, their variance over a square of area A is g^2 A / 12 along each side, and the mean of
/// |difference|^2 / length^2 over edges of all directions is half the sum of both g^2.
void Clusters::measure_roughness() {
    std::vector<double> slope(shades_.size()), edges(shades_.size());
    for (std::size_t i = 0; i < vertex_of_corner_.size(); i += 3)
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t a = vertex_of_corner_[i + k], b = vertex_of_corner_[i + (k + 1) % 3];
            const Vec3 along = position(b) - position(a), change = normal(b) - normal(a);
            if (place_of(a) == place_of(b) || dot(along, along) == 0) continue;
            for (const std::uint32_t end : {a, b}) {
                slope[end] += dot(change, change) / dot(along, along);
                ++edges[end];
            }
        }
    for (std::size_t i = 0; i < shades_.size(); ++i) {
        Shade& shade = shades_[i];
        const double mean = norm(shade.sum) / shade.area;
        const double goes_on = edges[i] > 0 ? slope[i] / edges[i] * shade.area / 6 : 0;
        shade.roughness = static_cast<float>(std::clamp(1 - mean * mean + goes_on, 0.0, 1.0));
    }
}

}  // namespace echoloop
