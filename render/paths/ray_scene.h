// Rays through a scene's triangles, by Embree. Double precision outside, single inside; knows no sound.
#pragma once

#include <memory>
#include <optional>
#include <span>

#include "render/scene/scene.h"

namespace echoloop {

struct RayHit {
    double range = 0;            ///< m, along the ray
    Vec3 normal;                 ///< of the triangle, unit, towards the ray's origin
    std::uint32_t material = 0;  ///< in Scene::materials()
    std::uint32_t object = 0;    ///< in Scene::objects()
    double height = 0;  ///< m, of the triangle over its longest side, or of the flat face that it is part of
};

/// What hit() is asked.
struct Ray {
    Vec3 origin, direction;
    double end = 0;
};

class RayScene {
  public:
    /// Builds its trees. `tolerance`: m, by how much curved surfaces that stand still may be off, so that
    /// stand-ins do for them; none of them hides what lies within twice of that of its plane. Throws
    /// std::runtime_error when Embree cannot.
    explicit RayScene(std::shared_ptr<const Scene> scene, double tolerance = 0);
    ~RayScene();

    /// Moves what moves: world_from_object of every mover, which have no place before. Costs next to nothing.
    void place(std::span<const Pose> movers);

    /// The first surface within `end` m along the unit vector `direction`; one-sided triangles are not there
    /// from behind. A few tenths of a millimetre at the origin are left out, so that a ray can start on a
    /// surface.
    std::optional<RayHit> hit(Vec3 origin, Vec3 direction, double end) const;

    /// The same for several rays, one `out` for each: quicker where neighbours in the list lie side by side.
    void hit(std::span<const Ray> rays, std::span<std::optional<RayHit>> out) const;

    /// Whether something lies between two points, either of which may be on a surface.
    bool blocked(Vec3 from, Vec3 to) const;

    /// m, the distance at a ray's ends within which nothing is seen.
    double skin() const;

  private:
    class Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace echoloop
