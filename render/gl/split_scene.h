// Long edges of a scene split up for one ping, so that what bent rays make of a surface is drawn bent. Needs
// no GL.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <unordered_map>
#include <vector>

#include "render/gl/seen.h"

namespace echoloop::gl {

/// Patches of one kind of views.
class SplitMesh {
  public:
    std::span<const SceneVertex> vertices() const { return vertices_; }
    /// Of a patch, counted from its first vertex.
    std::span<const std::uint16_t> indices() const { return indices_; }
    std::uint64_t version() const { return version_; }  ///< another after every change

  private:
    friend class SplitScene;
    struct Patch {
        SeenPatch drawn;
        Bounds bounds;
    };
    /// From where the nodes of a part are split.
    struct Place {
        Vec3 eye, up;
        friend bool operator==(const Place&, const Place&) = default;
    };
    struct Stretch {
        std::uint32_t first, last;  ///< in patches_
    };

    std::vector<SceneVertex> vertices_;
    std::vector<std::uint16_t> indices_;
    std::vector<Patch> patches_;
    std::unordered_map<std::uint32_t, Stretch> known_;  ///< by node
    std::vector<Place> places_;                         ///< of the parts that `known_` is for
    std::shared_ptr<const RayTable> rays_;              ///< and the rays
    double sag_ = 0, end_range_ = 0;                    ///< and the outlook
    std::uint64_t version_ = 0;
};

class SplitScene {
  public:
    explicit SplitScene(std::shared_ptr<const Scene> scene) : scene_(std::move(scene)) {}

    /// Takes the nodes with long edges out of `seen` and puts patches in their place: edges are halved until
    /// a bent one strays less than `outlook.sag` from a straight one, or eight times that in the surround,
    /// whose pixels are coarse. Whether an edge is halved depends on its ends alone, so surfaces stay closed.
    /// Decided for a lattice of places near the sonar's, by the rays of a depth nearby, so that pings share
    /// the work; a function of the outlook, not of what was split before.
    void split(const Outlook& outlook, std::vector<SeenView>& seen);

    /// What the patches of views are made of: of the surround, and of others.
    const SplitMesh& mesh(bool surround) const { return meshes_[surround ? 1 : 0]; }

  private:
    class Splitter;

    bool is_long(std::uint32_t node, double shortest);
    void start(SplitMesh& mesh, const Outlook& outlook, double sag, const SeenView& seen);
    void split_view(SplitMesh& mesh, const Outlook& outlook, double sag, SeenView& view);

    std::shared_ptr<const Scene> scene_;
    std::vector<float> longest_;       ///< m, of the edges of every node
    std::vector<std::uint32_t> long_;  ///< nodes of the part at hand
    std::array<SplitMesh, 2> meshes_;
};

}  // namespace echoloop::gl
