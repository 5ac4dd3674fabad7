// Merges the vertices of one mesh by the cells of a grid that is fixed in the world, so that neighbouring
// chunks which are made coarser alike still meet. Knows no chunks.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "render/scene/numbering.h"
#include "render/scene/quadric.h"
#include "render/scene/scene.h"

namespace echoloop {

/// All merged vertices of a mesh for one size of the cells. Each lies where its surface's planes meet best;
/// its normal is the mean by area of those that look the same way.
class Clusters {
  public:
    /// Cells of 2^exponent m. Every triangle has an area.
    Clusters(const Mesh& mesh, std::span<const std::uint32_t> indices, int exponent);
    /// Larger cells, from smaller ones.
    Clusters(Clusters&& finer, int exponent);

    std::size_t vertices() const { return shades_.size(); }
    std::size_t places() const { return places_.size(); }
    /// The merged vertex of corner `i` (3 t + 0..2) of the mesh.
    std::uint32_t vertex_of(std::size_t i) const { return vertex_of_corner_[i]; }
    /// Two vertices at one place differ in their normals only.
    std::uint32_t place_of(std::uint32_t vertex) const { return shades_[vertex].place; }
    Vec3 position(std::uint32_t vertex) const { return places_[place_of(vertex)].position; }
    Vec3 normal(std::uint32_t vertex) const { return shades_[vertex].normal; }
    /// Variance of the normals that facets around the vertex stand for, 0..1.
    float roughness(std::uint32_t vertex) const { return shades_[vertex].roughness; }
    /// m, about how far the merged surface is off around the vertex.
    double error(std::uint32_t vertex) const { return places_[place_of(vertex)].error; }

  private:
    struct Cell {
        std::int32_t x = 0, y = 0, z = 0;
        bool operator==(const Cell&) const = default;
        std::size_t hash() const {
            return mix(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y),
                       static_cast<std::uint32_t>(z));
        }
    };
    struct Place {
        Cell cell;
        Quadric planes;  ///< from the middle of the mesh
        Vec3 moment;     ///< sum of area times position
        double area = 0;
        Vec3 position;
        double error = 0;
        std::array<std::uint32_t, 6> shade{};  ///< by the axis that the normal is nearest to; 1 + index, or 0
    };
    struct Shade {
        std::uint32_t place = 0;
        std::uint32_t side = 0;
        Vec3 sum;  ///< of area times normal
        double area = 0;
        Vec3 normal;
        float roughness = 0;
    };

    std::uint32_t place_in(Numbering<Cell>& cells, Cell cell);
    std::uint32_t shade_in(std::uint32_t place, std::uint32_t side);
    void add_triangle(const Mesh& mesh, const std::uint32_t* corners, const Vec3* borders,
                      Numbering<Cell>& cells);
    void settle();
    void measure_roughness();

    double cell_;  ///< m
    int exponent_;
    Vec3 middle_;
    std::vector<Place> places_;
    std::vector<Shade> shades_;
    std::vector<std::uint32_t> vertex_of_corner_;
};

}  // namespace echoloop
