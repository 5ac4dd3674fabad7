// A scene as the sonar meets it: triangles in world coordinates (ENU, metres, z up) with acoustic materials,
// cut into chunks for culling. What moves is kept in a frame of its own. Immutable; reads nothing outside the
// scene file's folder and knows no GL.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "render/geographic.h"
#include "render/pose.h"
#include "render/scene/motion.h"

namespace echoloop {

/// A scene file that cannot be used. what() names the file, the place in it, the reason and the remedy.
class SceneError : public std::runtime_error {
  public:
    /// `place` is a JSON path such as "meshes[2].primitives[0].attributes.POSITION"; empty for the file as a
    /// whole.
    SceneError(std::string file, std::string place, std::string reason, std::string remedy);

    const std::string& file() const { return file_; }
    const std::string& place() const { return place_; }
    const std::string& reason() const { return reason_; }
    const std::string& remedy() const { return remedy_; }

  private:
    std::string file_, place_, reason_, remedy_;
};

/// One point of a curve of measured backscattering strength.
struct BackscatterPoint {
    double grazing_deg = 0;  ///< 0..90
    double strength_db = 0;  ///< Sb, dB re 1 m^2 per m^2 of surface, at 1 m
    friend bool operator==(const BackscatterPoint&, const BackscatterPoint&) = default;
};

/// How a surface scatters and reflects.
struct Material {
    std::string name;
    double mu_db = -27;         ///< 10 log10 of Lambert's constant; -4.97 (1/pi) is the ceiling
    bool double_sided = false;  ///< false: only the side that its winding faces is there at all, as glTF says
    std::vector<BackscatterPoint>
        backscatter{};          ///< strictly ascending grazing angles; empty: Lambert with mu_db
    double reflection = 0.353;  ///< amplitude of a mirrored wave at normal incidence, -1..1 (sand's)
    double roughness = 0.005;   ///< m, rms height, of which a mirrored wave is the weaker (sand's)
    double slope = 0.15;        ///< rms slope of its facets in one direction (sand's)
    /// What its facets mirror adds to Lambert's law; of sediments it is in their constant already.
    bool lobe = false;
    /// dB: how unlike its patches are, the standard deviation of the level of what is smaller than they; 0:
    /// even
    double patchiness = 0;
    /// rms slope of the triangles that stand for a curved surface; 0: flat. A SceneBuilder sets it.
    double mesh_slope = 0;

    friend bool operator==(const Material&, const Material&) = default;
};

/// Triangles given by a caller instead of a file. Counter-clockwise seen from the side that scatters.
struct Mesh {
    std::string object;  ///< identity of the thing, for ground truth
    Material material;
    std::vector<Vec3> positions;         ///< m, ENU
    std::vector<Vec3> normals;           ///< one per position, or empty: one per triangle is computed
    std::vector<std::uint32_t> indices;  ///< three per triangle
};

/// A point that echoes with a declared strength from all sides, for calibration. It has no surface and hides
/// nothing.
struct PointTarget {
    std::string name;
    Vec3 position;             ///< m, ENU
    double strength_db = -20;  ///< TS of the sonar equation: backscattering cross-section, dB re 1 m^2
    std::uint32_t mover = 0;   ///< 1 + index of the mover in whose frame it is; 0: the world
};

struct SceneVertex {
    std::array<float, 3> position;  ///< m, ENU
    std::array<float, 3> normal;    ///< unit
    /// 1 + its index in Scene::surfaces(); and as a fraction, of a stand-in's vertices, half the variance of
    /// the normals that facets around it stand for, 0..1.
    float surface;
};

/// What vertices have in common.
struct SceneSurface {
    std::uint32_t object = 0, material = 0;  ///< in Scene::objects() and Scene::materials()
};

/// A flat part of a surface: neighbouring triangles of one mesh in one plane.
struct SceneFace {
    Vec3 origin;             ///< m, in the plane, where u and v are 0
    Vec3 normal, u, v;       ///< unit, square to each other; the normal as the winding says
    double low[2], high[2];  ///< m, extent along u and v
    double area = 0;         ///< m^2
    /// In Scene::face_edges(): its outline and those of its holes, in no order.
    std::uint32_t first_edge = 0, edges = 0;
    std::uint32_t material = 0, mover = 0;  ///< as of SceneChunk
};

/// One straight piece of a face's outline, from (u, v) to (u, v), in m.
struct FaceEdge {
    std::array<float, 2> from, to;
};

/// A few hundred neighbouring triangles of one object and one material.
struct SceneChunk {
    std::uint32_t first_vertex = 0, vertices = 0;  ///< in Scene::vertices()
    std::uint32_t first_index = 0, indices = 0;    ///< in Scene::indices(), which count from first_vertex
    std::uint32_t object = 0, material = 0;        ///< in Scene::objects() and Scene::materials()
    Bounds bounds;
    std::uint32_t mover = 0;  ///< 1 + index of the mover in whose frame it is; 0: the world
    float facet = 0;          ///< m, the smaller side of the flat faces that it shows, typically; 0: curved
};

/// What can be drawn in one go: a chunk, or a coarse stand-in for all chunks of the nodes below.
struct SceneNode {
    Bounds bounds;
    std::uint32_t next = 0;  ///< index in Scene::nodes() of the first one that is not below this one
    std::uint32_t object = 0, material = 0;
    bool coarse = false;  ///< counts in coarse_vertices() and coarse_indices(), not in the fine ones
    std::uint32_t first_vertex = 0, vertices = 0;
    std::uint32_t first_index = 0, indices = 0;
    float error = 0;  ///< m, how far the stand-in is off, at most; infinite where there is none
};

/// What of a scene can move. Nothing, unless it is asked for.
struct SceneOptions {
    std::vector<std::string> movable{};  ///< names of nodes; the first of several with one name
    bool animations = false;             ///< nodes that the file's animations move
};

class Scene {
  public:
    /// Reads a .gltf (with .bin or data: buffers) or .glb. Throws SceneError.
    static std::shared_ptr<const Scene> load(const std::filesystem::path& file,
                                             const SceneOptions& options = {});
    /// Throws SceneError (file "meshes") for the same faults as load(). Meshes whose object is named in
    /// `movable` are given in its own frame, which lies in the world's until it is moved.
    static std::shared_ptr<const Scene> from_meshes(std::span<const Mesh> meshes,
                                                    std::span<const PointTarget> targets = {},
                                                    std::span<const std::string> movable = {});
    /// The same of meshes that the caller needs no more: large ones are not copied.
    static std::shared_ptr<const Scene> from_own_meshes(std::vector<Mesh> meshes);

    std::span<const SceneVertex> vertices() const { return all_vertices().first(fine_vertices_); }
    std::span<const std::uint16_t> indices() const { return all_indices().first(fine_indices_); }
    std::span<const SceneChunk> chunks() const { return chunks_; }
    /// Trees of nodes, parents before their children; every chunk is a node that has none below.
    std::span<const SceneNode> nodes() const { return nodes_; }
    std::span<const SceneVertex> coarse_vertices() const { return all_vertices().subspan(fine_vertices_); }
    std::span<const std::uint16_t> coarse_indices() const { return all_indices().subspan(fine_indices_); }
    /// The coarse ones follow the fine ones, as a rasteriser wants them.
    std::span<const SceneVertex> all_vertices() const { return vertices_; }
    std::span<const std::uint16_t> all_indices() const { return indices_; }
    std::span<const SceneSurface> surfaces() const { return surfaces_; }
    std::span<const std::string> objects() const { return objects_; }
    std::span<const Material> materials() const { return materials_; }
    std::span<const PointTarget> point_targets() const { return point_targets_; }
    /// The largest flat faces, at most scene_limits::faces, those of one mover together.
    std::span<const SceneFace> faces() const { return faces_; }
    std::span<const FaceEdge> face_edges() const { return face_edges_; }
    /// Of everything, with movers where the file puts them.
    const Bounds& bounds() const { return bounds_; }
    /// Of what does not move; empty bounds where everything does.
    const Bounds& still_bounds() const { return still_bounds_; }

    std::span<const SceneMover> movers() const { return movers_; }
    /// The nodes before this one are of what does not move.
    std::uint32_t still_nodes() const { return still_nodes_; }
    /// Of all nodes in the file's scene, depth first; one may be there several times.
    std::span<const std::string> node_names() const { return node_names_; }
    /// Where the world's origin lies on the Earth, if the file says so.
    const std::optional<GeoPlace>& origin() const { return origin_; }
    /// What of the file is left out that somebody might miss.
    std::span<const std::string> notes() const { return notes_; }
    std::size_t triangles() const { return fine_indices_ / 3; }

  private:
    friend class SceneBuilder;
    Scene() = default;
    std::vector<SceneVertex> vertices_;
    std::vector<std::uint16_t> indices_;
    std::vector<SceneChunk> chunks_;
    std::size_t fine_vertices_ = 0, fine_indices_ = 0;
    std::vector<SceneNode> nodes_;
    std::vector<SceneSurface> surfaces_;
    std::vector<std::string> objects_;
    std::vector<Material> materials_;
    std::vector<PointTarget> point_targets_;
    std::vector<SceneFace> faces_;
    std::vector<FaceEdge> face_edges_;
    Bounds bounds_, still_bounds_;
    std::vector<SceneMover> movers_;
    std::uint32_t still_nodes_ = 0;
    std::vector<std::string> node_names_, notes_;
    std::optional<GeoPlace> origin_;
};

}  // namespace echoloop
