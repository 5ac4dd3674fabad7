// Rays of a sonar in layered water as chains of chords, so that who follows straight ones can follow them.
// Built from exact arcs. Pure functions of a profile; knows no scene and no tree.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "render/ray_table.h"

namespace echoloop::rays {

/// By how much chords may stray from their rays: the larger of both.
struct ChordTolerance {
    double distance = 0;  ///< m
    double angle = 0;     ///< rad, seen from the sonar
    friend bool operator==(const ChordTolerance&, const ChordTolerance&) = default;
};

/// The places where chords meet lie on their rays. There are rays for some elevations of launch, close to
/// each other near level; how a ray differs that leaves a little higher is known at every place to the first
/// order.
class RayChains {
  public:
    /// Of the same water, depth and range as the table's. Where the water has a surface, a ray that turns
    /// above it ends there.
    RayChains(const RayTable& table, ChordTolerance tolerance);

    /// Rows go by the tangent of half the elevation of launch: row half + n is that of n |n| / half^2.
    static constexpr int half = 256, rows = 2 * half + 1;
    /// rad, the elevation of a row.
    static double elevation(int row);

    /// The chords of a row follow each other from `first` on, each from where the one before ends.
    struct Row {
        std::int32_t first = 0;
        float inverse_length = 0;  ///< 1/m of c t, of its first chord
    };
    const Row* row(std::int32_t number) const { return &rows_[static_cast<std::size_t>(number)]; }
    /// Sines of elevation: all rays below the one and above the other are straight.
    float lowest_bent() const { return lowest_bent_; }
    float highest_bent() const { return highest_bent_; }

    static constexpr std::size_t cache_line = 64;
    /// What a chord and its arcs have is shifted by `rise` times the slopes for a ray that leaves `rise` rad
    /// above its row. Lengths are m of c t, with c the sound speed at the sonar. In groups of four, which a
    /// processor reads at once.
    struct alignas(cache_line) Chord {
        /// m: horizontal distance and height over the sonar of where it begins; how much both grow.
        std::array<float, 4> way;
        std::array<float, 4> way_slope;  ///< m/rad
        float length = 0;                ///< where it begins
        float inverse_length = 0;        ///< 1/m, of its own length
        float next = 0;                  ///< m, where another begins that follows it; infinite: none does
        std::int32_t arc = 0;            ///< its first
        /// Share of it where the second arc begins, infinite if there is none; and per rad.
        float second_arc = 0, second_arc_slope = 0;
    };
    const Chord* chords() const { return chords_.data(); }

    /// A part of the bent ray over a chord: where that begins, and how much more where it ends.
    struct alignas(cache_line) Arc {
        /// Elevation over that of launch (rad) and its growth, length and its growth.
        std::array<float, 4> turn;
        std::array<float, 4> turn_slope;
        /// Distance between rays above each other (m/rad), that between rays abreast over that of straight
        /// ones, the sound speed over that at the sonar, its growth over the sum of both ends'.
        std::array<float, 4> spread;
        std::array<float, 4> spread_growth;
        /// Share of the chord where it begins, which is 0 for a chord's first, and 1 over its own share; m
        /// over the chord where it begins, and its growth.
        std::array<float, 4> part;
        std::array<float, 4> part_slope;
    };
    /// Behind the last one is that of another chord.
    const Arc* arcs() const { return arcs_.data(); }

  private:
    std::vector<Row> rows_;
    float lowest_bent_ = 2, highest_bent_ = -2;
    std::vector<Chord> chords_;
    std::vector<Arc> arcs_;
};

}  // namespace echoloop::rays
