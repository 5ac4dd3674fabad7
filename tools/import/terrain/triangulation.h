// Few triangles for many samples: greedy insertion (Garland and Heckbert, Fast Polygonal Approximation of
// Terrains and Height Fields, CMU-CS-95-181, 1995). The sample that is farthest off becomes a corner, until
// none is farther off than the error allows. So the error is known, not estimated.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <vector>

#include "tools/import/terrain/heights.h"

namespace echoloop::worlds {

struct TriangulationRules {
    double error = 0.1;                  ///< m, up or down, of any sample
    std::size_t most = 2'000'000;        ///< triangles
    std::int32_t lattice = 0;            ///< every so many samples one is a corner; 0: none has to be
    std::function<void(double)> told{};  ///< now and then: which share of the work is done, about
};

struct Triangulation {
    std::vector<GridPoint> corners{};                       ///< each is a sample that is known
    std::vector<std::array<std::uint32_t, 3>> triangles{};  ///< counter-clockwise, x to the right, y upwards
    double error = 0;        ///< m, of the worst sample; more than the rules' where the triangles ran out
    std::size_t needed = 0;  ///< triangles before any was chosen: for the edges of holes and for the lattice
    std::size_t lone = 0;    ///< samples that are left out, since no cell around them is known
};

/// Cells with a corner that is not known are holes, to the sample: none is ever bridged or filled. Where the
/// holes' edges alone need more triangles than the rules allow, `needed` says so and there are no triangles.
/// Takes samples that belong to no cell away from `heights`.
Triangulation triangulate(Heights& heights, const TriangulationRules& rules);

}  // namespace echoloop::worlds
