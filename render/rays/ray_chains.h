// Rays of a sonar in layered water as chains of chords, so that who follows straight ones can follow them.
// Built from exact arcs. Pure functions of a profile; knows no scene and no tree.
#pragma once

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

    /// Of every row the place where it begins, which is the sonar, at length 0. A chord leads from each place
    /// to the next, whose length is greater; that after a row's last is 0.
    struct Row {
        std::int32_t first = 0;
        std::int32_t bends = 0;    ///< 0: it is straight
        float inverse_length = 0;  ///< 1/m of c t, of its first chord
    };
    const Row* row(std::int32_t number) const { return &rows_[static_cast<std::size_t>(number)]; }
    /// Those of a ray that leaves `rise` rad above its row are shifted by `rise` times the slopes.
    struct Places {
        std::vector<float> length, length_slope;  ///< m of c t, with c the sound speed at the sonar; m/rad
        std::vector<float> x, x_slope;            ///< m, horizontal distance; m/rad
        std::vector<float> z, z_slope;            ///< m above the sonar
        std::vector<float> bow, bow_slope;        ///< rad, elevation there over that of launch; 1
        std::vector<float> width;                 ///< m/rad, between rays above each other
        std::vector<float> beside;  ///< distance between rays abreast over that of straight ones
        std::vector<float> speed;   ///< of sound over that at the sonar
    };
    const Places& places() const { return places_; }
    std::size_t chords() const { return places_.length.size() - 1 - static_cast<std::size_t>(rows); }

  private:
    std::vector<Row> rows_;
    Places places_;
};

}  // namespace echoloop::rays
