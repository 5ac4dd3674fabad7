// Follows the rays of a view where they bend, chord by chord to the first surface.
#pragma once

#include <array>
#include <span>

#include "render/rays/bent_packet.h"
#include "render/rays/traced_parts.h"

namespace echoloop::rays {

class BentTracer {
  public:
    /// `reach`: m of c t. The view's place, the parts and the chains are kept by reference.
    BentTracer(const ViewPlace& place, std::size_t samples, const TracedParts& parts, const RayChains& chains,
               float reach);

    /// Those of neighbouring lines, at most tile_lines.
    void trace(std::span<const TracedLine> lines);

  private:
    /// Rays that are looked for at once.
    struct Tile {
        RTCRayHit16 query;
        BentRays rays;
        BentRays::Numbers y;                                           ///< places on the image plane
        alignas(packet_alignment) std::array<int, packet_rays> asked;  ///< -1: still under way, else 0
        bool straight;  ///< it is followed as straight rays are
        bool any;
    };

    /// `number`: of those that begin at `sample`.
    void start(Tile& tile, std::size_t number, std::size_t sample, std::size_t lines);
    void aim_straight(Tile& tile) const;
    /// Those still under way.
    void aim(std::span<Tile> tiles);
    void take_hits(Tile& tile, std::size_t number);

    const ViewPlace& place_;
    std::size_t samples_;
    const TracedParts parts_;
    const RayChains& chains_;
    float reach_;
    std::array<float, packet_rays> x_{};
    std::array<Tile, tiles_at_once> tiles_;
    std::array<HitArrays, tile_lines> hits_{};
    std::array<BentHits, tile_lines> bent_{};
};

}  // namespace echoloop::rays
