// Rays that the water's surface reflects, where sound speed has layers. Behind the surface the water goes on
// as its mirror image, so the first ray by way of the surface is the first one to a point's image there, and
// has a table as others have. Knows no scene.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "render/ray_table.h"
#include "render/recently_used.h"

namespace echoloop {

/// rad, by which the straight line to where a ray is after `length` m of c t lies higher than it leaves, with
/// the sine `up` of elevation.
double lift_to(const RayTable& rays, double up, double length);

/// The tables that one renderer has needed of late.
class ImageTables {
  public:
    /// That of a sonar at most a quarter of a metre off `depth` (m), for ranges up to `range` m or farther.
    std::shared_ptr<const RayTable> of(std::span<const SoundSpeedPoint> profile, double depth, double range);

  private:
    RecentlyUsed<std::shared_ptr<const RayTable>> tables_{8};
};

/// Those of one ping. The table is made when it is first asked for, in some milliseconds.
class ImageRays {
  public:
    /// `own`: the table of direct rays; both are kept by reference.
    ImageRays(ImageTables& tables, const RayTable& own) : tables_(tables), own_(own) {}

    /// The first ray to the image that is `distance` m off horizontally and `above` m above the sonar;
    /// arrival and launch as RayTable::at(). What the sonar is off from the table's depth, Snell's law mends
    /// but for the second order.
    BentRay to(double distance, double above) const;
    /// rad, as lift_to(), of the line to the image of where a ray is.
    double lift(double up, double length) const;

  private:
    const RayTable& table() const;
    /// rad, elevation at another sound speed (Snell).
    static double refracted(double elevation, double ratio);

    ImageTables& tables_;
    const RayTable& own_;
    mutable std::shared_ptr<const RayTable> table_;
};

}  // namespace echoloop
