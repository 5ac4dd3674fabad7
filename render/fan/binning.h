// From rendered pixels to received power per beam and bin. Plain CPU code, deterministic; knows no GL, no
// noise and no pulse: those act on its result.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "render/echogram.h"
#include "render/fan/plan.h"

namespace echoloop {

/// What the renderer writes for one pixel.
struct Pixel {
    float range;   ///< m, Euclidean, at the sample point
    float cosine;  ///< of the angle of incidence, 0..1
    float
        footprint;  ///< m, range that the pixel covers on its surface's plane; negative: mostly along bearing
    float surface;  ///< 0: nothing; else 1 + index of its object and material
};

struct BinningInput {
    const FanPlan& plan;
    std::span<const Pixel> pixels;  ///< plan.lines x plan.samples
    std::span<const float> mu;      ///< Lambert's constant per surface index
    PixelOffset offset;             ///< where in the pixels the ping sampled
    EchoRule rule;
    double first_range = 0;  ///< m, leading edge of bin 0
    double bin_length = 0;   ///< m
    std::size_t beams = 0, bins = 0;
    double source_power = 1;  ///< uPa^2 at 1 m
    double absorption = 0;    ///< Np/m
};

/// Fills `values` (beams x bins, beam-major). For EchoRule::radiometric the sum over pixels of
/// SL mu cos(i) dw R^-2 exp(-4 a R); for EchoRule::cerqueira2016 the mean of cerqueira_sigmoid(cos(i)).
/// Power before the first or beyond the last bin is dropped, never wrapped or piled up.
void bin_pixels(const BinningInput& input, std::vector<float>& values);

/// The sigmoid of Cerqueira et al. 2016, equation 1, with the constants of the authors' code.
float cerqueira_sigmoid(float cosine);

}  // namespace echoloop
