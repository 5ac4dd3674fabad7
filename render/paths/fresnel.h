// Fresnel's integrals, and what a strip of a mirror leaves of a mirrored wave. Pure functions.
#pragma once

#include <complex>

namespace echoloop {

/// C(u) + i S(u), the integral of exp(i pi t^2 / 2) from 0 to u, within 1e-4: a table up to 4; beyond, the
/// first two terms of the auxiliary functions' series (Abramowitz & Stegun 1964, 7.3.27-28).
std::complex<double> fresnel_integral(double u);

/// How a mirror's zones lie about the point where a path meets it.
struct MirrorZone {
    double per_metre =
        0;  ///< u = per_metre x, sqrt(2 (d1 + d2) / (lambda d1 d2)); 2 / sqrt(lambda R) for R = d1 = d2
    double delay = 0;       ///< 1/m: an edge at x is heard delay x^2 m of apparent range later
    double resolution = 0;  ///< m of range, that of the pulse
};
/// `before`, `after`: m, from source and to receiver.
MirrorZone mirror_zone(double wavenumber, double before, double after, double resolution);

/// Share of the amplitude of a full plane that a strip from `low` to `high` m leaves: [C + iS] / (1 + i)
/// between its ends (Medwin & Clay, Fundamentals of Acoustical Oceanography, 1998, chapter 7). An edge whose
/// own echo comes later than the pulse is long has no part in it.
std::complex<double> strip_share(const MirrorZone& zone, double low, double high);

}  // namespace echoloop
