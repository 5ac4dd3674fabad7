#include "render/acoustics/sea_surface.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "render/water.h"

namespace echoloop {
namespace {

/// Of the bubbles' layer, for a ray straight up.
double extinction(double khz, double wind) {
    constexpr double strong = 11;  // m/s
    const double exponent = -5.2577 + 0.4701 * std::min(wind, strong);
    const double more = wind > strong ? std::pow(wind / strong, 3.5) : 1;
    return std::pow(10, exponent) * std::pow(khz / 25, 0.85) * more;
}

}  // namespace

double bubble_backscatter(double frequency, double wind, double sine) {
    constexpr double reradiation = 0.0136;
    if (!(wind > 0) || !(sine > 0)) return 0;
    const double khz = frequency / 1e3, damping = 0.0255 * std::cbrt(khz);
    const double vertical = extinction(khz, wind), beta = vertical / sine;
    const double ways = (1 + 8 * beta * std::exp(-2 * beta) - std::exp(-4 * beta)) / (2 * beta);
    return reradiation * vertical / (4 * std::numbers::pi * damping) * ways;
}

double surface_slope(double wind) {
    constexpr double least = 0.02;
    const double twice = 0.0046 * std::log(std::max(2.1 * wind * wind, 1.0));
    return std::max(std::sqrt(twice / 2), least);
}

double wave_height(double wind) { return 0.0053 * wind * wind; }

double surface_bubble_loss_db(double frequency, double wind, double sine) {
    constexpr double breaking = 6;  // m/s
    if (!(wind > 0)) return 0;
    const double calm = wind < breaking ? std::exp(1.2 * (wind - breaking)) : 1;
    return 1.26e-3 / std::max(sine, least_bubble_sine) * std::pow(std::max(wind, breaking), 1.57) *
           std::pow(frequency / 1e3, 0.85) * calm;
}

double surface_backscatter(double frequency, double wind, double sine) {
    if (!(wind > 0) || !(sine > 0)) return 0;
    const double slope = surface_slope(wind), square = slope * slope, sine2 = sine * sine;
    const double tangent2 = 1 / sine2 - 1;  // of the angle of incidence
    const double facets =
        std::exp(-tangent2 / (2 * square)) / (8 * std::numbers::pi * square * sine2 * sine2);
    const double grazing = std::min(std::asin(std::min(sine, 1.0)), 1.4);  // the facets rule beyond
    const double ripples = std::min(1.3e-5 * wind * std::pow(std::tan(grazing), 4), 1.0);
    const double loss = db_to_power(-surface_bubble_loss_db(frequency, wind, sine));
    return bubble_backscatter(frequency, wind, sine) + loss * (facets + ripples);
}

}  // namespace echoloop
