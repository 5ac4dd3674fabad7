// Fills a picture's pixels by rays through the scene, as gl::DrawingCrew does by drawing it. What is found
// does not depend on the number of threads, nor on what was asked before.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "render/gl/drawing_crew.h"
#include "render/pixel.h"
#include "render/rays/bent_tracer.h"
#include "render/rays/detail_tree.h"
#include "render/rays/ray_chains.h"
#include "render/rays/ray_packet.h"
#include "render/rays/traced_parts.h"
#include "render/recently_used.h"
#include "render/scene/scene.h"
#include "render/workers.h"

namespace echoloop::rays {

class RaySampler {
  public:
    /// `threads`: the caller's included. Throws std::runtime_error when Embree cannot start.
    RaySampler(std::shared_ptr<const Scene> scene, std::size_t threads);

    /// As gl::DrawingCrew::draw(), but that bent rays show all of several ways to a surface and not the
    /// first alone. Throws std::runtime_error where a tree cannot be made.
    void sample(const Picture& picture, const gl::Outlook& outlook, std::vector<Pixel>& pixels);

    /// Of the last sample(): `cull` is for trees, and triangles are those in them.
    const gl::DrawProfile& profile() const { return profile_; }
    static std::string description();

  private:
    /// For which eyes and views a tree is: equal for many pings.
    struct TreeKey {
        std::uint32_t part = 0;  ///< 0: what stands still; else 1 + the number of a mover
        Vec3 eye{};              ///< on a lattice of places
        double tolerance = 0, reach = 0;
        bool coarse = false;  ///< the tolerance falls near the sonar
        friend bool operator==(const TreeKey&, const TreeKey&) = default;
    };
    struct KnownTree {
        TreeKey key;
        std::shared_ptr<const DetailTree> tree;
    };
    /// A part of the scene where it is at the ping.
    struct Placed {
        std::shared_ptr<const DetailTree> tree;
        RotationRows world_from_part;
        embree::Geometry instance;
    };
    /// What views of one tolerance see.
    struct World {
        double tolerance = 0;
        bool coarse = false;
        std::vector<Placed> parts;
        embree::Tree all;  ///< of the parts, where there are movers
        RTCScene scene() const { return all ? all.get() : parts[0].tree->scene(); }
    };
    struct KnownChains {
        std::shared_ptr<const RayTable> rays;
        ChordTolerance tolerance;
        std::unique_ptr<const RayChains> chains;
    };
    /// Some lines of a view.
    struct Piece {
        const View* view;
        const World* world;
        const RayChains* chains;  ///< null: rays are straight
        std::size_t first_line, last_line;
    };

    const World& world_for(const View& view, const gl::Outlook& outlook);
    Placed placed(const World& world, std::uint32_t part, const gl::Outlook& outlook);
    const RayChains& chains_for(const View& view, const gl::Outlook& outlook);
    static void trace(const Piece& piece, const Picture& picture, const gl::Outlook& outlook, Pixel* pixels);

    std::shared_ptr<const Scene> scene_;
    embree::Device device_;
    RecentlyUsed<KnownTree> trees_{96 << 20};
    RecentlyUsed<KnownChains> chains_{16};
    std::vector<std::unique_ptr<World>> worlds_;  ///< of the picture at hand
    std::vector<Piece> pieces_;
    Workers workers_;
    gl::DrawProfile profile_;
};

}  // namespace echoloop::rays
