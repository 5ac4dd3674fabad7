// Echoes that the rasteriser cannot see: targets of declared strength, and those that come by way of the
// surface, the bottom or a corner. Rays through the scene with Embree; never moves or changes a direct echo,
// knows no GL.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "render/echogram.h"
#include "render/effects.h"
#include "render/scene/scene.h"

namespace echoloop {

class RayTable;

/// The water's surface, a flat and pressure-releasing plane: reflection -1 times exp(-2 (k s sin g)^2), one
/// way.
struct WaterSurface {
    double height = 0;     ///< m, z in the world
    double roughness = 0;  ///< m, rms wave height s
    /// rms slope in one direction, of what it mirrors incoherently: that of a wind of 5 m/s (sea_surface.h)
    double slope = 0.095;
    /// m/s, 10 m above the water: for bubbles and for what the surface scatters back; 0: neither
    double wind = 0;
};

/// Diffuse echo by an indirect path, already with source level, spreading, absorption, reflections and the
/// patterns of both directions except the receiver's horizontal one of a fan of several beams.
struct PathEcho {
    float near_range = 0,
          far_range = 0;  ///< m, apparent slant range: half the path's length; spread evenly between
    float power = 0;      ///< uPa^2, as if the pulse were infinitely short
    float bearing = 0;    ///< rad, where it arrives from, relative to Shot::pan
    /// rad, where the shot has rows: over the fan's plane, and how far the directions reach that it comes
    /// from; the receiver's vertical pattern is left out too.
    float elevation = 0, width = 0, height = 0;
    float turned = 0;  ///< rad, of `bearing`: what the sonar has turned by since the transmission
};

/// The echo of a target of declared strength by one of its paths, or that of a corner. Echoes of one range
/// and bearing add coherently.
struct TargetEcho {
    double range = 0;    ///< m, apparent slant range
    double power = 0;    ///< uPa^2, all but the receiver's horizontal pattern of a fan of several beams
    double phase = 0;    ///< rad, of the path's length and reflections
    double bearing = 0;  ///< rad, of arrival, relative to Shot::pan
    int bounces = 0;     ///< reflections on the way there and back
    double elevation =
        0;  ///< rad, over the fan's plane; where the shot has rows, its vertical pattern is left out too
    double turned = 0;  ///< rad, of `bearing`: what the sonar has turned by since the transmission
};

struct PathEchoes {
    std::vector<PathEcho> diffuse;
    std::vector<TargetEcho> targets;
};

class PathTracer {
  public:
    /// Builds Embree's tree of the scene when it is first needed.
    PathTracer(std::shared_ptr<const Scene> scene, std::optional<WaterSurface> surface, Effects effects);
    ~PathTracer();

    /// Adds the echoes of one ping to `out`. `movers`: world_from_object of all that the scene has.
    /// `absorption` in Np/m (0 when off), `end_range` in m. Cost is bounded: a fixed number of rays, placed
    /// by the low-discrepancy sequence of the ping's number. `turning`: rad/s, of the sonar about the fan's
    /// axes: echoes arrive where it looks by then. `rays`: null where they are straight.
    void trace(const Shot& shot, const Pose& world_from_sonar, double sound_speed, double absorption,
               double end_range, PathEchoes& out, std::span<const Pose> movers = {}, Vec3 turning = {},
               const RayTable* rays = nullptr);

    /// Begins to build that tree on a thread of its own, if it is needed, so that trace() need not wait for
    /// all of it.
    void prepare();

    /// False where trace() could add nothing: no targets, and multipath off.
    bool needed() const;

  private:
    class Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace echoloop
