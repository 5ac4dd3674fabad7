// Which nodes of a scene a view draws: what it can see, as coarse as its pixels allow. Conservative; knows no
// GL.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "render/ray_table.h"
#include "render/scene/scene.h"
#include "render/simd.h"
#include "render/view.h"

namespace echoloop::gl {

struct ViewLimits {
    double end_range = 0;  ///< m, nothing farther is wanted
    double margin = 0;     ///< by which the view's pyramid is grown, on the image plane
    double tolerance = 0;  ///< rad, by which a surface may be off where that allows a coarser stand-in
    double full_tolerance_range =
        0;                   ///< m, from where on it may be that; nearer, it falls with the square of range
    double begin_range = 0;  ///< m, nothing nearer is wanted but for what it hides
    double hiding_tolerance = 0;     ///< rad, the tolerance of that
    const RayTable* rays = nullptr;  ///< null: they are straight
};

/// Nodes [first, last) of a scene: whole trees in one frame.
struct NodeRange {
    std::uint32_t first = 0, last = 0;
};

/// Indices of nodes in `range` that reach into the view and together hold everything that it sees of them,
/// nearest first. `frame_from_fan`, `up`: in the frame of those nodes. Returns whether any of them may reach
/// into the ranges that are wanted.
bool find_visible(const Scene& scene, NodeRange range, const View& view, const Pose& frame_from_fan,
                  const ViewLimits& limits, std::vector<std::uint32_t>& nodes, Vec3 up = {0, 0, 1});

/// The same for all views from within `radius` m of `eye`, whose limits know no sides, rays and near end:
/// indices in ascending order.
std::vector<std::uint32_t> find_around(const Scene& scene, NodeRange range, Vec3 eye, double radius,
                                       const ViewLimits& limits);

/// Which boxes may reach into a view. The limits' rays are kept by reference.
class SeenBoxes {
  public:
    SeenBoxes(const View& view, const Pose& frame_from_fan, const ViewLimits& limits, Vec3 up);
    bool has(const Bounds& box) const;
    /// Of a box that is near enough: whether it may be seen between the sides of the view.
    bool between_sides(const Bounds& box) const;

  private:
    // Of each side:
    Four x_, y_, z_;  ///< its inward normal
    Four upwards_;    ///< the upward part of that
    Four most_lift_;  ///< m, by which rays lift what is within the end range over it, times the normal's
                      ///< length
    Vec3 eye_;
    double end_range_;
    const RayTable* rays_;
};

}  // namespace echoloop::gl
