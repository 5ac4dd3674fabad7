// What moves while a ping is under way: the ranges and the receiver's directions that this changes. Knows no
// scene and no GL.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "render/fan/plan.h"
#include "render/motion.h"
#include "render/view.h"

namespace echoloop {

/// All of it is as seen by the array, in its fan's frame (x along its axis, y to port, z up): the sonar sends
/// where it is at the transmission, and receives what comes from `range` m a time of 2 range / c later.
struct PingMotion {
    /// m/s of the sonar less those of what scatters, per surface; one for all where nothing else moves. Of a
    /// body that turns: of its part that is at the sonar, since turning about the sonar changes no range.
    std::vector<Vec3> approach{{}};
    Vec3 own{};           ///< m/s of the sonar
    double fastest = 0;   ///< m/s, no closing speed is more
    bool shifts = false;  ///< ranges change by what matters
    double slowness = 0;  ///< s/m, 1 / c
    double sweep = 0;     ///< s, see sweep_bias()
    Vec3 turning{};       ///< rad/s of the receiver; 0 where it turns by less than what matters
    /// Two-way power over the sine of the elevation, or of a piston's angle off its axis, where the receiver
    /// is directive there and turns; else empty.
    LobeTable upwards{};
    /// rad, one-way widths of a lobe that sends and receives, across a single beam and upright; 0: it does
    /// not.
    double across = 0, upright = 0;
    double axis = 0;     ///< rad, bearing of a single beam
    bool round = false;  ///< a piston's, which has one width

    /// s from the transmission until an echo comes back.
    double flight(double range) const { return 2 * range * slowness; }
    /// m, the range at which an echo appears: half of both legs, less what a sweep makes of the closing
    /// speed.
    double apparent(double range, double closing) const {
        return range - closing * (range * slowness + sweep);
    }
    /// Share of what is everywhere that the turned receiver still hears of what was sent, as a plain line
    /// does: 6 / a^2 (1 - sin(a) / a), the autocorrelation of sinc^2 (own derivation).
    double kept(double range) const;
};

/// What a motion is made of.
struct PingMoves {
    Quat world_from_fan;
    Vec3 sonar;  ///< m, in the world
    Motion own;  ///< in the world, the turning about the fan's axes
    std::span<const Pose> movers;
    std::span<const Motion> mover_motions;            ///< what is missing at the end is at rest
    std::span<const std::uint32_t> mover_of_surface;  ///< 1 + its index; 0: the world
};

/// `plan`: of the shot's beams. Empty where nothing moves by what matters: a tenth of a bin at the window's
/// end, or a tenth of a beam's width or height. With Shot::velocities it is there all the same, for its
/// speeds.
std::optional<PingMotion> motion_of(const Shot& shot, const FanPlan& plan, const PingMoves& moves,
                                    const Effects& effects, double sound_speed);

/// rad, that a fan of so many beams should be drawn finely beyond its edges, where it turns so fast (rad/s,
/// about its upright axis): what comes into it while an echo is under way. In whole steps, so that plans
/// serve many pings; 0 where it matters to no beam.
double margin_of(const Shot& shot, const Effects& effects, double turning);

/// m/s, of each sample of a line, by where in the pixels the ping sampled; positive: nearer.
void find_closing(const PingMotion& motion, const View& view, PixelOffset offset, std::size_t line,
                  const float* surface, std::vector<float>& closing);

/// What the beams of an array hear of each sample: the plan's `weight`, whose patterns are those of a
/// receiver that stays as it is, with those of one that has turned until the sample's echo comes back. Of a
/// single beam both ways; of a fan its height only, since beams weigh lines by their bearings. Main lobes
/// only. `range` in m; without a surface the weight means nothing.
void weigh_turned(const FanPlan& plan, const PingMotion& motion, const View& view, PixelOffset offset,
                  std::size_t line, const float* range, const float* surface, const float* weight,
                  std::vector<float>& out);

/// Ranges in m, as they appear.
void shift_ranges(const PingMotion& motion, std::span<const float> closing, std::vector<float>& ranges);

}  // namespace echoloop
