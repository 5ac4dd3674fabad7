// The stretches of range between the samples of a level line, and how much of the line's weight lies in each.
// Never guesses what is seen at an outline, where the mean over pings would not forgive it.
#pragma once

#include <vector>

#include "render/fan/pixel_rows.h"

namespace echoloop {

/// Stretch i lies between the samples i - 1 and i; those before the first and after the last sample go as far
/// as the line's pixels do.
struct Stretches {
    std::vector<float> near, middle, far;  ///< m, count + 1
    std::vector<float> of_upper,
        of_lower;                   ///< weight that the sample above and the one below have in the stretch
    std::vector<float> at_sample;   ///< count: weight that stays around where it was sampled
    std::vector<float> half_width;  ///< m, count: of what it is spread over there
};

/// Samples lie somewhere in their pixels. On a plane 1 / R is linear in the angle, and the echo between two
/// samples lies between their ranges; each sample owns the part of a stretch that is in its pixel. So a plane
/// sounds the same wherever the samples fall, and no bin is left out.
///
/// Elsewhere nobody knows what is between two samples: where the one surface ends and the other begins, or by
/// how much a crest hides the trough behind it. There each sample keeps its weight: that has the right mean
/// over pings whatever there is, and whatever the size of the pixels. It is spread over what a pixel of the usual
/// size shows of its plane (EchoSpread): less would blur the mean less, but single pings would be combs; what
/// the neighbours say would depend on the number of pixels.
///
/// Where range changes mostly across lines, a stretch is as wide as that, for the same reasons.
///
/// `weight`: of each pixel, of which the share `coverage` counts. `bin_length` and `end` of the window: m.
/// Stretches without weight have meaningless ranges.
void find_stretches(const PixelRow& row, const View& view, const float* coverage, const float* weight,
                    PixelOffset offset, float bin_length, float end, Stretches& out);

}  // namespace echoloop
