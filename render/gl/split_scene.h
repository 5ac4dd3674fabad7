// Long edges of a scene split up for one ping, so that what bent rays make of a surface is drawn bent. Needs
// no GL.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <unordered_map>
#include <vector>

#include "render/gl/seen.h"

namespace echoloop::gl {

class SplitScene {
  public:
    explicit SplitScene(std::shared_ptr<const Scene> scene) : scene_(std::move(scene)) {}

    /// Takes the nodes with long edges out of `seen` and puts patches in their place: edges are halved until
    /// a bent one strays less than `outlook.sag` from a straight one. Whether an edge is halved depends on
    /// its ends alone, so surfaces stay closed. A function of the outlook, not of what was split before.
    void split(const Outlook& outlook, std::vector<SeenView>& seen);

    std::span<const SceneVertex> vertices() const { return vertices_; }
    std::span<const std::uint32_t> indices() const { return indices_; }
    std::uint64_t version() const { return version_; }  ///< another after every change

  private:
    struct Patch {
        std::uint32_t first, count;
        bool double_sided;
        Bounds bounds;
    };
    struct NodePatches {
        std::uint32_t node;
        std::size_t first, last;  ///< in patches_
    };
    class Splitter;

    bool is_long(std::uint32_t node, double shortest);
    void split_part(const Outlook& outlook, std::size_t part, double shortest, std::vector<SeenView>& seen);

    std::shared_ptr<const Scene> scene_;
    std::vector<float> longest_;  ///< m, of the edges of every node
    std::vector<SceneVertex> vertices_;
    std::vector<std::uint32_t> indices_;
    std::vector<Patch> patches_;
    std::uint64_t version_ = 0;
};

}  // namespace echoloop::gl
