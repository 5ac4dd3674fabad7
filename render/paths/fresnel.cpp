#include "render/paths/fresnel.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace echoloop {
namespace {

/// Of the integral from minus infinity to x, over 1 + i: the step of geometrical optics, and the edge's wave.
std::complex<double> up_to(const MirrorZone& zone, double x) {
    const std::complex<double> whole = fresnel_integral(zone.per_metre * x) / std::complex(1.0, 1.0);
    const double step = std::copysign(0.5, x);
    const double in_time = zone.resolution > 0 ? std::max(0.0, 1 - zone.delay * x * x / zone.resolution) : 1;
    return step + in_time * (whole - step);
}

}  // namespace

std::complex<double> fresnel_integral(double u) {
    const double x = std::abs(u), angle = std::numbers::pi / 2 * x * x;
    std::complex<double> value;
    if (x < 1.8) {
        std::complex<double> term = x;
        for (int n = 0; n < 24; ++n) {
            value += term / (2.0 * n + 1);
            term *= std::complex(0.0, angle) / (n + 1.0);
        }
    } else {
        const double f = (1 + 0.926 * x) / (2 + 1.792 * x + 3.104 * x * x);
        const double g = 1 / (2 + 4.142 * x + 3.492 * x * x + 6.670 * x * x * x);
        value = {0.5 + f * std::sin(angle) - g * std::cos(angle),
                 0.5 - f * std::cos(angle) - g * std::sin(angle)};
    }
    return u < 0 ? -value : value;
}

MirrorZone mirror_zone(double wavenumber, double before, double after, double resolution) {
    const double curvature = (before + after) / (before * after);
    return {std::sqrt(curvature * wavenumber / std::numbers::pi), curvature / 4, resolution};
}

std::complex<double> strip_share(const MirrorZone& zone, double low, double high) {
    return up_to(zone, high) - up_to(zone, low);
}

}  // namespace echoloop
