// Neighbouring rays that bend, chord by chord, and what they meet turned into what straight rays would: in
// the widest vectors of the processor. Knows no tree.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "render/rays/ray_chains.h"
#include "render/rays/ray_packet.h"

namespace echoloop::rays {

/// How the rays of a tile leave the sonar, and how far they have got.
struct BentRays {
    using Numbers = std::array<float, packet_rays>;
    Numbers ahead_x, ahead_y;                     ///< horizontal direction, of length 1
    Numbers rise;                                 ///< rad, over the row of RayChains
    std::array<std::int32_t, packet_rays> chord;  ///< the one at hand
    Numbers from;                                 ///< share of it that is behind
    Numbers next;                                 ///< as RayChains::Chord::next
};

/// The chords at hand of a tile: from `x`, `y`, `z` in the scene's frame, as far as `to_x`, `to_y`, `to_z`
/// tell, between the shares `begin` and `end`, which is less where nothing is wanted.
struct Chords {
    float *x, *y, *z, *to_x, *to_y, *to_z, *begin, *end;
};

/// Whether the rays through the places `x` and `y` of the image plane leave steeper than all that bend.
bool all_straight(const ViewAxes& axes, const float* x, const float* y, const RayChains& chains);

/// Rays through those places, from `near` m off.
void launch(const ViewAxes& axes, const float* x, const float* y, const RayChains& chains, float near,
            BentRays& rays);

inline constexpr std::size_t most_tiles = HitArrays::most / tile_samples;

/// Of several tiles, at most most_tiles. `reach`: m of c t, beyond which nothing is wanted.
void find_chords(const RayChains& chains, std::span<BentRays* const> rays, const float* eye, float reach,
                 const Chords* to);

/// Those rays of a tile that met nothing go on with the next chord if it begins within `reach`; others are
/// `asked` no more. `met`: Embree's number of what each met. A bit for each that met something.
std::uint32_t go_on(const unsigned* met, float reach, BentRays& rays, int* asked);

/// What bent rays met along a line: beside HitArrays, whose depth is the share of the chord.
struct BentHits {
    std::array<float, HitArrays::most> rise;
    std::array<std::int32_t, HitArrays::most> chord;
};

/// Makes those of the samples [first, last) hits of the straight rays that leave so: as far off as the bent
/// ones are in time, and with normals turned with the ray; those of triangles' planes so that what a pixel
/// covers has the same ranges. The arc between two places, not its chord, meets the plane.
void straighten(const ViewAxes& axes, const RayChains& chains, float x, const float* y, const BentHits& bent,
                std::size_t first, std::size_t last, HitArrays& hits);

}  // namespace echoloop::rays
