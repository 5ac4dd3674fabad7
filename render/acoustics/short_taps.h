// The shortest filter that makes numbers with a given correlation out of white ones.
#pragma once

#include <span>
#include <vector>

namespace echoloop {

/// By how much the correlation at any lag may be off: far less than is seen in the bins of one ping. A choice
/// of ours.
inline constexpr double taps_error = 0.025;

/// As few taps as have the `correlation` (lag 0 first, where it is 1; beyond the last lag it is 0) within
/// taps_error at every lag, or nearly so where no filter has it. The sum of their squares is 1. Of all
/// filters of that length it is that whose correlation comes nearest by least squares. Found by Levenberg's
/// and Marquardt's method; the steps without their damping are Wilson's (SIAM J. Numer. Anal. 6 (1969) 1).
std::vector<double> short_taps(std::span<const double> correlation);

}  // namespace echoloop
