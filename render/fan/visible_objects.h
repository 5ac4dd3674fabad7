// What the main lobes of a ping look at, and how much of each object the others hide. By straight rays
// through the triangles themselves, apart from what is drawn: for labels, of who asks only.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "render/echogram.h"
#include "render/paths/ray_scene.h"

namespace echoloop {

/// Solid angles in sr, of an object within the field of a ping.
struct ObjectInView {
    std::uint32_t object = 0;    ///< in Scene::objects()
    double seen = 0, whole = 0;  ///< what nothing hides; as if there were no other object
};

/// A beam looks at `object` between these ranges.
struct BeamSight {
    std::uint32_t object = 0;
    double near = 0, far = 0;  ///< m
};

struct Look {
    std::vector<ObjectInView> objects;           ///< ascending; within the field and the range of the ping
    std::vector<std::vector<BeamSight>> sights;  ///< of each beam, in no order
};

class VisibleObjects {
  public:
    /// Builds a tree of its own. Throws as RayScene.
    explicit VisibleObjects(std::shared_ptr<const Scene> scene) : rays_(std::move(scene)) {}

    /// A main lobe reaches one beam_width and one fan_height to either side of its axis, a little less than
    /// the first zero of an unshaded array's (1.1 of them one way, 1.6 both ways). `end`: m, nothing beyond
    /// counts. `turn`: rad, so much wider are the lobes of a sonar that turns while it listens. There are
    /// four columns of 64 rays for a beam's width, 24 at least; what is thinner than their distance may be
    /// missed. By one thread at a time.
    Look look(const Shot& shot, const Pose& world_from_sonar, std::span<const Pose> movers, double end,
              double turn);

  private:
    RayScene rays_;
};

}  // namespace echoloop
