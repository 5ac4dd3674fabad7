// From a pixel's range to the bins of the window.
#pragma once

#include "render/fan/binning.h"
#include "render/fan/line_echoes.h"

namespace echoloop {

/// m, of the window.
inline float end_of(const BinningInput& in) {
    return static_cast<float>(in.first_range + static_cast<double>(in.bins) * in.bin_length);
}

/// From m to bins.
inline BinScale scale_of(const BinningInput& in) {
    return {static_cast<float>(1 / in.bin_length), static_cast<float>(in.first_range / in.bin_length)};
}

}  // namespace echoloop
