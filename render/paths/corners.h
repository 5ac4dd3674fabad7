// Corners that rays come across: where two or three surfaces meet at right angles. Says nothing of their
// echo.
#pragma once

#include <vector>

#include "render/paths/path_ping.h"

namespace echoloop {

/// A point in which two or three mirrors meet at right angles, nearest to the sonar on their common edge.
struct Corner {
    Vec3 point;
    int faces = 2;  ///< 2 or 3
};

/// m, radius of the disc of the area lambda R / 2, which stands for a mirror's Fresnel zones at the range R.
double mirror_zone_radius(double wavenumber, double range);

/// Collects the corners of one ping, each once and at most eight.
class CornerList {
  public:
    CornerList(const PathPing& ping, std::vector<Corner>& corners) : ping_(ping), corners_(corners) {}

    /// A ray was mirrored by `first` and then met `second` in the direction `onward`. Surfaces within one
    /// degree of a right angle make a corner; whether a third one joins them is seen by one more ray.
    void note(const Encounter& first, const Encounter& second, Vec3 onward);

  private:
    void add(const Corner& corner);

    const PathPing& ping_;
    std::vector<Corner>& corners_;
    int thirds_ = 0;
};

}  // namespace echoloop
