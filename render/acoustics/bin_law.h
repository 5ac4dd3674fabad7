// How the intensity of a bin scatters about its mean: by how many independent looks are in it, and by what
// the receiver makes of them. Pure functions; draws no numbers.
#pragma once

#include <array>
#include <functional>

#include "render/echogram.h"

namespace echoloop {

/// The intensity of a bin over its mean power, as a function of a normal variable z that rises with it. So
/// whatever the receiver makes of the looks, bins and beams correlate by correlated normal numbers.
struct BinLaw {
    static constexpr std::size_t terms = 9;
    /// Of the polynomial in z that is the cube root of the intensity, within 0.0015 of the distribution for
    /// |z| < 5.2.
    std::array<float, terms> root{};
    double mean = 1;  ///< of the intensity: above 1 where bins keep the strongest look
    bool operator==(const BinLaw&) const = default;
};

/// mean: of `looks` >= 1 exponential variables; peak: the greatest of them; sample: one.
BinLaw bin_law(BinRule rule, double looks);

/// Gamma distributed with this shape > 0 and mean 1.
BinLaw gamma_law(double shape);

/// Correlation of the echo's or the noise's intensity with itself over `x` m of range.
using RangeCorrelation = std::function<double(double x)>;

/// Independent looks whose mean scatters as the mean over a bin of that length does (Goodman, Speckle
/// Phenomena in Optics, 2007, chapter 4): 2 in a bin as long as a CW pulse, 1.41 in half of one.
double looks_in(const RangeCorrelation& correlation, double bin_length);

}  // namespace echoloop
