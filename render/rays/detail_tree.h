// The triangles that sonars near one place see, as coarse as their pixels allow, in a tree for rays. Knows no
// picture.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "render/gl/culling.h"
#include "render/paths/embree.h"
#include "render/scene/scene.h"

namespace echoloop::rays {

/// What a hit needs of a triangle, as a linear function of where it is hit: the normal, and a quarter over
/// the surface number with its fraction, as SceneVertex has it.
struct alignas(16) TriangleCorners {
    std::array<float, 4> first, to_second, to_third;
};

class DetailTree {
  public:
    /// Of the nodes of one frame, for eyes within `radius` m of `eye`.
    DetailTree(const embree::Device& device, const Scene& scene, gl::NodeRange range, Vec3 eye, double radius,
               const gl::ViewLimits& limits);

    bool empty() const { return triangles() == 0; }
    std::size_t triangles() const { return corners_[0].size() + corners_[1].size(); }
    std::size_t chunks() const { return chunks_; }
    std::size_t bytes() const;
    RTCScene scene() const { return tree_.get(); }
    /// By the number of the geometry: 0 is there from one side only, 1 from both.
    const TriangleCorners* corners(unsigned geometry) const { return corners_[geometry].data(); }

  private:
    void attach(const embree::Device& device, const Scene& scene, unsigned geometry);

    std::array<std::vector<std::uint32_t>, 2> indices_;  ///< in Scene::all_vertices()
    std::array<std::vector<TriangleCorners>, 2> corners_;
    std::size_t chunks_ = 0;
    embree::Tree tree_;
};

}  // namespace echoloop::rays
