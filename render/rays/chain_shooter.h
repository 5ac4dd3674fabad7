// The points of one ray after the other through layered water, each from exact arcs, and how neighbouring
// rays differ there. Knows no chords.
#pragma once

#include <cstddef>
#include <vector>

#include "render/ray_table.h"
#include "render/water.h"

namespace echoloop::rays {

/// Where a ray is, and how its neighbours differ: `width` is the distance between rays of the same time over
/// that of their launch (m/rad), `spread` how it grows, over the sound speed (Cerveny, Seismic Ray Theory,
/// 2001, section 4.1: Q and P of dynamic ray tracing).
struct ChainPoint {
    double x = 0, z = 0, length = 0;  // m
    double elevation = 0;             // rad
    double width = 0, spread = 0;     // m/rad, s/m
    double speed = 0;                 // m/s
};

/// Shoots one ray after the other through the layers of a profile.
class ChainShooter {
  public:
    /// `sag`: m, by which a ray may stray from a straight line between two of its points.
    ChainShooter(const RayTable& table, double sag);

    /// Fills in the points of a ray of that elevation, which stands for those up to `blur` rad off.
    void shoot(double elevation, double blur, std::vector<ChainPoint>& out);

  private:
    static constexpr int most_layers = 8192;  ///< that a ray crosses

    double depth() const { return depth_ - points_->back().z; }

    double gradient(std::size_t layer) const;
    void start(double elevation);
    bool cross_layer();
    void cross(double speed);
    void go_straight(double length);
    void go(double thickness, double speed, double sine);
    void step(double thickness, double speed, double sine, double angle);

    /// Between two points: rad, and the share of sound speed.
    static constexpr double most_turn = 0.1, most_change = 0.04;

    std::vector<SoundSpeedPoint> levels_;
    double depth_, speed_, range_, sag_;
    bool surface_;
    std::vector<ChainPoint>* points_ = nullptr;
    double snell_ = 0, sine_ = 0, blur_ = 0;
    std::size_t layer_ = 0;
    bool down_ = false, level_ = false;
};

}  // namespace echoloop::rays
