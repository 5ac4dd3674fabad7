// What the staves of one unit, which differ from each other, do to the pattern of its array. Pure functions
// of the unit; knows no scene and no beams.
#pragma once

#include <complex>
#include <cstddef>
#include <vector>

#include "render/acoustics/pattern.h"

namespace echoloop {

/// A stave n of weight w and place x has a gain g of its own, and the array's pattern is the sum of w g e^(i
/// k x u) over that of w, u the sine of the angle off a beam's axis: what the ideal pattern lacks is the same
/// for every beam, and the same at every ping. Its mean power is (sa^2 + sp^2) / N_eff of the main lobe's,
/// one way, with sa = dB / 8.686 and sp in rad, and exponentially distributed (Allen 1961; Steinberg,
/// Principles of Aperture and Array System Design, 1976, chapter 13; Van Trees, Optimum Array Processing,
/// 2002, 2.6.3), where the errors are independent. Those of staves less than about a wavelength apart are
/// not, and so what is near a beam's axis is louder, and the floor falls away from it.
class StaveErrors {
  public:
    /// Wavelengths over which neighbours err alike, by exp(-(x / it)^2). Fit: with 1.4 dB and 14 deg the
    /// nadir's ring falls from 15 to 36 deg as in water columns of an EM 2040 at 300 kHz. That it is so in
    /// other arrays, and farther out, is inferred: coupling reaches about as far.
    static constexpr double coupled = 1.1;

    /// `ideal`: of a line, shaded or not. `staves`: 0 or 1: as many as lie half a wavelength apart. `alike`:
    /// wavelengths, 0: independent errors.
    StaveErrors(const AperturePattern& ideal, std::size_t staves, const ArrayErrors& errors,
                double alike = coupled);

    /// One way, power relative to the main lobe, at `angle` rad off the axis, clockwise positive. Behind its
    /// plane the array hears as the ideal one does.
    double power(double angle) const;
    /// Amplitude of the same, in front of the array, at the sine of the angle.
    std::complex<float> at_sine(double sine) const;

    /// As many staves without weights would have the same noise.
    double effective_staves() const { return effective_; }

  private:
    AperturePattern ideal_;
    double effective_ = 0, step_ = 0;
    std::vector<std::complex<float>> table_;  ///< over the sine, -1..1
    float main_lobe_ = 1;                     ///< power on the axis before it is made 1
};

}  // namespace echoloop
