// Rough mirrors one after the other: what comes back of the energy that the coherent echo loses. Pure
// functions.
#pragma once

#include <span>

namespace echoloop {

/// A rough mirror on a path from the sonar back to it.
struct ChainMirror {
    double at = 0;     ///< share of the whole path's length at which it lies, 0..1
    double slope = 0;  ///< rms slope of its facets in one direction; 0: smooth
};

/// Along one axis of the beam: the share of a smooth chain's power that comes back incoherently, and what it
/// arrives with. Facets turn the path by 2 s each; with the beam exp(-angle^2 / spread^2) both ways,
///     1 / sqrt(det(I + S (a a' + b b') / spread^2)), a_j = at_j - 1, b_j = at_j, S = diag(4 s_j^2),
/// (own derivation, in the approximation of small angles; a Monte Carlo run agrees within 0.1 dB). For one
/// mirror, both axes together: 1 / (1 + 2 s^2 / spread^2).
struct ChainShare {
    double power = 1;
    double variance = 0;  ///< rad^2, of the angle of arrival
};
/// `spread`: rad, infinite for a beam that hears everything alike.
ChainShare chain_share(std::span<const ChainMirror> mirrors, double spread);

}  // namespace echoloop
