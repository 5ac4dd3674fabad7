// The speed of sound in sea water. A pure function.
#pragma once

namespace echoloop::survey {

/// m/s, by Medwin, JASA 58 (1975) 1318: 0 to 35 degC, 0 to 45 parts per thousand, to 1000 m. Which formula a
/// maker takes is not public.
constexpr double sound_speed(double temperature, double salinity, double depth) {
    const double t = temperature;
    return 1449.2 + 4.6 * t - 0.055 * t * t + 0.00029 * t * t * t + (1.34 - 0.01 * t) * (salinity - 35) +
           0.016 * depth;
}

}  // namespace echoloop::survey
