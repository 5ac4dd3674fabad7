// What the sectors of an array hear of one line of the surround. Knows no bins.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "render/fan/plan.h"

namespace echoloop {

/// Of every pixel of the line, by where in it the ping sampled.
struct SurroundHearing {
    std::vector<float> beside, off_plane;  ///< sr, solid angle times the pattern; for sectors of that kind
    std::vector<float> place;              ///< among the sectors
    std::vector<std::int32_t> sector;      ///< the one before that place, the first of a kind being 0
    std::vector<float> next;               ///< share of the one behind it
    bool any_beside = false, any_off_plane = false;

    /// `single`: the array is a single beam, which has one sector for both kinds.
    void find(std::span<const SurroundPixel> pixels, PixelOffset offset, bool single);
};

}  // namespace echoloop
