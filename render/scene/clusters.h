// Merges the vertices of one mesh by the cells of a grid that is fixed in the world; all of the mesh alike,
// so that neighbouring chunks still meet. Knows no chunks.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "render/scene/mesh_loops.h"
#include "render/scene/numbering.h"
#include "render/scene/quadric.h"
#include "render/scene/scene.h"
#include "render/scene/scratch.h"

namespace echoloop {

/// What has been merged into one place: its planes, and where they meet best.
struct MergedPlace {
    Quadric planes;  ///< from Clusters::middle()
    Vec3 moment;     ///< sum of area times position
    double area = 0;

    void add(const MergedPlace& other) {
        planes.add(other.planes);
        moment = moment + other.moment;
        area += other.area;
    }
    /// From Clusters::middle(); no farther from the mean position than the place is wide, at least `width`.
    Vec3 position(double width = 0) const;
    /// m, how far the surface is off at most, where its curvature is constant.
    double error(Vec3 position) const { return 2 * planes.rms(position); }
};

/// The mean of normals by area.
struct MeanNormal {
    Vec3 normal;          ///< unit; zero where they cancel out
    float roughness = 0;  ///< variance of the normals that facets around stand for, 0..1
};

struct NormalSum {
    Vec3 sum;  ///< of area times normal
    double area = 0;

    void add(const NormalSum& other) {
        sum = sum + other.sum;
        area += other.area;
    }
    MeanNormal mean() const;
};

/// A triangle that is left after merging.
struct MergedTriangle {
    std::uint32_t number;  ///< in the mesh
    std::array<std::uint32_t, 3> corners;
};

/// All merged vertices of a mesh. Each lies where its surface's planes meet best; its normal is the mean by
/// area of those that look the same way.
class Clusters {
  public:
    /// By cells of `cell` m, a multiple of 2^-n. Every triangle has an area. `places`: welded() of the mesh's
    /// positions. Fills in the place of every index where `place_of_corner`, which has as many, is given.
    Clusters(const Mesh& mesh, std::span<const std::uint32_t> places, std::span<const std::uint32_t> indices,
             double cell, Scratch<std::uint32_t>* place_of_corner = nullptr);

    Vec3 middle() const { return middle_; }
    std::size_t vertices() const { return shades_.size(); }
    std::size_t places() const { return places_.size(); }
    const MergedPlace& place(std::size_t i) const { return places_[i].merged; }
    /// In the mesh's order.
    std::span<const MergedTriangle> triangles() const { return triangles_; }
    /// Two vertices at one place differ in their normals only.
    std::uint32_t place_of(std::uint32_t vertex) const { return shades_[vertex].place; }
    /// The axis that its normal is nearest to, and which way.
    std::uint32_t side_of(std::uint32_t vertex) const { return shades_[vertex].side; }
    const NormalSum& normals(std::uint32_t vertex) const { return shades_[vertex].normals; }
    Vec3 position(std::uint32_t vertex) const;
    /// m, about how far the merged surface is off around the vertex.
    double error(std::uint32_t vertex) const;

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
        MergedPlace merged;
        std::array<std::uint32_t, 6> shade{};  ///< by the axis that the normal is nearest to; 1 + index, or 0
    };
    struct Shade {
        std::uint32_t place = 0;
        std::uint32_t side = 0;
        NormalSum normals;
    };

    struct Corner;

    std::uint32_t shade_in(std::uint32_t place, std::uint32_t side, std::vector<Shade>& shades);
    std::uint32_t add_corner(const Corner& corner, std::uint32_t index, std::vector<Shade>& shades);
    void add_share(std::size_t share, const Mesh& mesh, std::span<const std::uint32_t> indices,
                   std::span<const Vec3> borders, std::span<const std::uint32_t> cell_of_corner,
                   std::vector<Shade>& shades);
    void number_cells(const Mesh& mesh, std::span<const std::uint32_t> indices, MeshLoops& loops,
                      std::span<std::uint32_t> cell_of_corner);

    double cell_;  ///< m
    Vec3 middle_;
    std::vector<Place> places_;
    std::vector<Shade> shades_;
    std::vector<MergedTriangle> triangles_;
};

}  // namespace echoloop
