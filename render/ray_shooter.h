// The rays of a sonar in layered water, one after the other, and where they cross the rows of a table of
// depths. Knows no scene.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "render/layered_ray.h"

namespace echoloop::rays {

inline constexpr int most_turns = 4;
inline constexpr int kinds = most_turns + 1;  ///< arrivals by the number of times that the ray has turned

/// A level that a ray crosses: a row of the table, or where the gradient changes.
struct Level {
    double depth, speed;
    int row;  ///< -1: none
};

/// Where a ray crosses a row; what of it the table keeps.
struct Crossing {
    double distance, turn, stretch, bow, clearance;
};

/// Those of one ray and row, by the number of turns before; those that there are, as bits.
struct RowCrossings {
    unsigned there = 0;
    std::array<Crossing, kinds> all;
    bool has(std::size_t kind) const { return (there >> kind & 1U) != 0; }
};

/// The rays of a fan, one after the other, into the rows of a table.
class Shooter {
  public:
    Shooter(std::vector<Level> levels, double depth, double speed, double most_distance)
        : levels_(std::move(levels)), depth_(depth), speed_(speed), most_distance_(most_distance) {
        above_ = -1;
        for (std::size_t i = 0; i < levels_.size() && levels_[i].depth < depth; ++i)
            above_ = static_cast<int>(i);
    }

    /// Fills the crossings of a ray of that elevation, rad.
    void shoot(double elevation, std::vector<RowCrossings>& out) const {
        for (RowCrossings& row : out) row.there = 0;
        const double snell = std::cos(elevation) / speed_;
        int way = elevation < 0 ? 1 : -1, next = elevation < 0 ? above_ + 1 : above_, turns = 0;
        double depth = depth_, speed = speed_, sine = std::abs(std::sin(elevation)), x = 0, t = 0,
               apex = std::numeric_limits<double>::infinity();
        while (next >= 0 && next < std::ssize(levels_) && x < most_distance_) {
            const Level& level = levels_[static_cast<std::size_t>(next)];
            const double thickness = std::abs(level.depth - depth);
            if (snell * level.speed >= 1) {  // it turns where the sine is 0, and comes back to where it is
                if (++turns > most_turns) return;
                const double share = std::clamp((1 / snell - speed) / (level.speed - speed), 0.0, 1.0);
                if (share * thickness > 0 && sine > 0) {
                    const LayerStep half = layer_step(snell, share * thickness, speed, sine, 1 / snell, 0);
                    x += 2 * half.distance, t += 2 * half.time;
                }
                if (way < 0) apex = std::min(apex, depth - share * thickness);
                way = -way;
                next += way;
                // Back at the level that it came from, or at the sonar's depth, which is none.
                const int here = next;
                if (here >= 0 && here < std::ssize(levels_) &&
                    levels_[static_cast<std::size_t>(here)].depth == depth) {
                    note(levels_[static_cast<std::size_t>(here)], elevation, x, t, sine, way, turns, apex,
                         out);
                    next += way;
                }
                continue;
            }
            const double sine_there = sine_of(snell, level.speed);
            if (thickness > 0) {
                const LayerStep step = layer_step(snell, thickness, speed, sine, level.speed, sine_there);
                x += step.distance, t += step.time;
            }
            depth = level.depth, speed = level.speed, sine = sine_there;
            note(level, elevation, x, t, sine, way, turns, apex, out);
            next += way;
        }
    }

  private:
    void note(const Level& level, double elevation, double x, double t, double sine, int way, int turns,
              double apex, std::vector<RowCrossings>& out) const {
        if (level.row < 0) return;
        const double below = level.depth - depth_;
        const double arrival = std::atan2(way > 0 ? -sine : sine, sine_of(sine, 1));
        RowCrossings& row = out[static_cast<std::size_t>(level.row)];
        row.there |= 1U << turns;
        row.all[static_cast<std::size_t>(turns)] = {
            x, elevation - std::atan2(-below, x), t * speed_ / std::hypot(x, below) - 1, arrival - elevation,
            std::min({apex, depth_, level.depth}) - std::min({0.0, depth_, level.depth})};
    }

    std::vector<Level> levels_;
    double depth_, speed_, most_distance_;
    int above_;  ///< the last level above the sonar
};

}  // namespace echoloop::rays
