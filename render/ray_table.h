// Where a sonar in layered water sees what: for points around one depth of the sonar, the launch angle, the
// travel time and the angle of arrival of the first ray there, beside those of a straight line; and how rays
// spread. Built from exact arcs. Pure functions of a profile; knows no scene and no GL.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "render/simd.h"
#include "render/water.h"

namespace echoloop {

/// What the first ray to a point differs in from the straight line there.
struct BentRay {
    double turn = 0;     ///< rad, launch elevation over the line's
    double stretch = 0;  ///< c t over the line's length, less 1, with c the sound speed at the sonar
    double bow = 0;      ///< rad, elevation of arrival over that of launch
    /// m of water over the highest point of the ray, or less; negative: no ray goes there below the surface.
    double clearance = 0;
};

class RayTable {
    static constexpr int focus_rows = 129, focus_columns = 64;

  public:
    /// Of rays from `depth` m, to `range` m of c t. `surface`: rays do not go beyond the depth 0; else water
    /// goes on above. Takes some milliseconds. The profile has a point at least.
    RayTable(std::span<const SoundSpeedPoint> profile, double depth, double range, bool surface);

    /// The first ray to the point that is `distance` m off horizontally and `below` m deeper than the sonar.
    /// Between the table's points it is linear, beyond them as at their edge.
    BentRay at(double distance, double below) const;

    /// Power per area at the end of a ray's length `length` m (of c t) that leaves with the sine `up` of
    /// elevation, over that at the end of a straight one: the spreading G of Jensen et al. (2011,
    /// section 3.3) times length^2. Within 0.1..10, since a ray tube says too much near a caustic. The
    /// table is the RayTable's.
    class FocusTable {
      public:
        FocusTable(const float* all, float per_metre) : all_(all), per_metre_(per_metre) {}
        ECHOLOOP_INLINE std::int32_t place(float up, float length) const {
            const float row = (up + 1) * (0.5F * (focus_rows - 1)), column = length * per_metre_;
            const auto r = static_cast<int>(row + 0.5F),
                       c = static_cast<int>(std::min(column, focus_columns - 1.F) + 0.5F);
            return r * focus_columns + c;
        }
        float operator[](std::int32_t place) const { return all_[place]; }
        const float* all() const { return all_; }  ///< by place()

      private:
        const float* all_;
        float per_metre_;
    };
    FocusTable focus_table() const { return {focus_.data(), focus_per_metre_}; }
    float focus(float up, float length) const {
        const FocusTable table = focus_table();
        return table[table.place(up, length)];
    }
    /// Whether that differs from 1 by more than 2 % anywhere within the range.
    bool focuses() const { return focuses_; }

    /// Where the ray is then that leaves in the direction d with the sine `up` of elevation: at length times
    /// (along d + rise w) from the sonar, with w upwards. For a straight ray 1 and 0. The other way round
    /// from at(); linear between 1/64 of sine and of range.
    struct Place {
        float along = 1, rise = 0;
        float height(float up) const { return along * up + rise; }  ///< over the length
    };
    Place place(float up, float length) const {
        const float row = std::clamp((up + 1) * (0.5F * (focus_rows - 1)), 0.0F, focus_rows - 1.001F),
                    column = std::clamp(length * focus_per_metre_, 0.0F, focus_columns - 1.001F);
        const auto r = static_cast<int>(row), c = static_cast<int>(column);
        const float fr = row - static_cast<float>(r), fc = column - static_cast<float>(c);
        const Place* upper = &ends_[static_cast<std::size_t>(r * focus_columns + c)];
        const Place* lower = upper + focus_columns;
        const auto between = [&](float Place::*m) {
            const float a = upper[0].*m + fc * (upper[1].*m - upper[0].*m),
                        b = lower[0].*m + fc * (lower[1].*m - lower[0].*m);
            return a + fr * (b - a);
        };
        return {between(&Place::along), between(&Place::rise)};
    }

    /// The water's surface as rays meet it, by the sine of elevation with which they leave: `places` of its
    /// root, with its sign, from -1 to 1. Linear in the sine between them, as 1 / length is for straight
    /// rays.
    struct Surfacing {
        static constexpr int half = 128, places = 2 * half + 1;
        std::vector<float> inverse;  ///< 1/m, of the length in c t; 0: it never does
        std::vector<float> sine;     ///< of the elevation with which it arrives
        std::vector<float> slope;    ///< -d log(length) / d log(up): 1 for a straight ray
        bool straight = true;        ///< as straight rays do, within 0.02 %
    };
    /// Empty where there is no surface over the sonar.
    const Surfacing& surfacing() const { return surfacing_; }

    /// c t over the length of a straight line between two depths, m below the sonar. By Fermat's principle a
    /// bent ray between its ends takes as long, but for the second order of its bend.
    double slowness(double below_1, double below_2) const;

    std::span<const SoundSpeedPoint> profile() const { return profile_; }
    double depth() const { return depth_; }    ///< m
    double range() const { return range_; }    ///< m, of c t
    double speed() const { return speed_; }    ///< m/s, at the sonar
    bool surface() const { return surface_; }  ///< whether it bounds the water

    /// m, by how much straight rays are off at most, up to the range `range` m; infinite where there is a
    /// shadow.
    double straight_error(double range) const;
    double most_turn() const { return most_turn_; }  ///< rad
    /// What crosses a plane through the sonar because rays bend: a point up to `range` m off that a straight
    /// line would show at the sine s of elevation over a plane whose unit normal has the part n upwards is
    /// seen above it only if s >= -n lift (downwards: -n and the other lift).
    double lift(double range, bool down) const {
        const auto step =
            static_cast<std::size_t>(std::ceil(range / column_step_)) + 2;  // it is interpolated
        return lifts_[down ? 1 : 0][std::min(step, columns - 1)];
    }
    double most_stretch() const { return most_stretch_; }  ///< |stretch|
    bool has_shadow() const { return has_shadow_; }
    double steepest() const { return steepest_; }  ///< 1/s, the greatest gradient of sound speed

    /// Where we see a point, and how its ray arrives there: one that is `level` m from the sonar along the
    /// level and `height` m above it is seen at (1 + outwards) level and height + rise.
    struct Move {
        float outwards = 0;
        float rise = 0;       ///< m
        float bow = 0;        ///< rad/m: BentRay::bow over the level distance where it is seen
        float clearance = 0;  ///< m, as of a BentRay
    };
    /// As at(), of the point there.
    Move move(double distance, double below) const;

    static constexpr std::size_t columns = 128, rows = 128;
    /// Rows x columns: columns by distance from 0, rows by depth.
    std::span<const Move> moves() const { return moves_; }
    double column_step() const { return column_step_; }  ///< m
    /// Rows lie closer near the sonar's depth: row r is a u + b u |u| m below it, with u = r + first.
    struct Rows {
        double a = 1, b = 0, first = 0;
        double below(double row) const {
            const double u = row + first;
            return (a + b * std::abs(u)) * u;
        }
        double row(double below) const {
            const double u = 2 * std::abs(below) / (a + std::sqrt(a * a + 4 * b * std::abs(below)));
            return std::copysign(u, below) - first;
        }
    };
    const Rows& row_places() const { return places_; }

  private:
    void shoot(std::span<const SoundSpeedPoint> profile, bool surface);
    void close_gaps();
    void find_moves();
    void find_errors(bool surface);
    void find_lift(std::size_t step, double distance, double below, double turn);
    void find_focus(std::span<const SoundSpeedPoint> profile);
    void find_surface(std::span<const SoundSpeedPoint> profile);
    double plumb(double below) const;

    std::vector<SoundSpeedPoint> profile_;
    double depth_, range_;
    bool surface_;
    double speed_;
    double column_step_ = 1;
    Rows places_;
    struct Corners {
        std::size_t upper;  ///< the first of the four points around, of which the others follow
        float across, down;
    };
    Corners corners(double distance, double below) const;

    std::vector<std::array<float, 4>> cells_;  ///< turn, stretch, bow and clearance
    std::vector<Move> moves_;                  ///< in the same places
    std::array<double, rows> plumb_{};         ///< m of c t, down from the first row
    std::vector<float> focus_;
    std::vector<Place> ends_;  ///< in the same places
    Surfacing surfacing_;
    float focus_per_metre_ = 0;
    std::array<double, columns> error_{};                 ///< m, within that many steps of range
    std::array<std::array<double, columns>, 2> lifts_{};  ///< the same
    double most_turn_ = 0, most_stretch_ = 0;
    double steepest_ = 0;
    bool focuses_ = false, has_shadow_ = false;
};

}  // namespace echoloop
