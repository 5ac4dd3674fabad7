// All rays from a sonar in layered water to a point: where they turn, as in a duct, there are several, and a
// table of bent rays has the first of them alone. Knows no scene.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "render/ray_table.h"

namespace echoloop {

/// One of them.
struct Eigenray {
    double elevation = 0;  ///< rad, with which it leaves
    double length = 0;     ///< m, of c t with c the sound speed at the sonar
    double focus = 1;      ///< as RayTable::focus()
};

/// Those of a sonar at one depth. Made from exact arcs in about a millisecond.
class Eigenrays {
  public:
    explicit Eigenrays(const RayTable& table);

    /// Whether these are the sonar's.
    bool fits(const RayTable& table) const;

    /// Fills in those to the point that is `distance` m off horizontally and `below` m deeper than the sonar,
    /// in the order of their arrival, 12 at most. Those that differ by less than 2 mm and 1 deg are taken for
    /// one, as no wave tells them apart. None where there can be no other than the first, as no ray that
    /// turns leads there, and in a shadow.
    void find(double distance, double below, std::vector<Eigenray>& out) const;

    /// m below the sonar, of a ray of that elevation at so many places, `distance` m apart.
    void course(double elevation, double distance, std::span<double> below) const;

  private:
    struct State {
        double x = 0, depth = 0;  ///< m
        double sine = 0;          ///< of the angle below the horizontal
        double time = 0;          ///< s
        double highest = 0;       ///< m, the least depth so far
        std::size_t layer = 0;
    };

    enum class Found { none, known, added };

    State launched(double elevation) const;
    bool between_faster(const State& ray) const;
    bool advance(State& ray, double snell, double x, bool timed) const;
    std::size_t layer_of(double depth, double sine) const;
    double speed_at(double depth, std::size_t layer) const;
    double row_elevation(int row) const;
    float depth_in_row(std::size_t row, double distance) const;
    /// m, by how much deeper than `below` a ray is at the distance; infinite above the surface.
    double missed(double elevation, double distance, double below) const;
    Found add(double low, double high, double distance, double below, std::vector<Eigenray>& out) const;

    static constexpr int half = 128;  ///< rows to either side of level
    static constexpr std::size_t rows = 2 * half + 1, columns = 128;

    double depth_, range_, speed_;
    bool surface_;
    std::vector<SoundSpeedPoint> given_, levels_;
    std::vector<double> gradients_;  ///< 1/s, of the layer above each level, and below the last
    double steepest_ = 0;            ///< rad, beyond which no ray leads that turns
    double column_step_ = 1;         ///< m
    std::vector<float> below_;       ///< m, rows x columns; infinite above the surface
};

}  // namespace echoloop
