// One ray through layered water from level to level, by Snell's law: exact arcs without a loss of digits
// where sound speed hardly changes. Knows no sonar.
#pragma once

#include <cmath>

namespace echoloop {

/// Between two depths in which sound speed changes evenly (Jensen et al., Computational Ocean Acoustics,
/// 2011, section 3.3), for a ray of Snell's constant `snell` (s/m, cosine of elevation over sound speed):
///     dx = (C1 - C2) / (snell q), dt = (atanh C1 - atanh C2) / q, C = sqrt(1 - snell^2 c^2),
/// written so that no difference of nearly equal numbers is left.
struct LayerStep {
    double distance = 0;  ///< m, horizontal
    double time = 0;      ///< s
};

inline double sine_of(double snell, double speed) {
    const double cosine = snell * speed;
    return std::sqrt(std::max(0.0, (1 - cosine) * (1 + cosine)));
}

/// `thickness`: m, positive; speeds in m/s and sines of elevation at both ends.
inline LayerStep layer_step(double snell, double thickness, double speed_1, double sine_1, double speed_2,
                            double sine_2) {
    const double sum = speed_1 + speed_2, sines = sine_1 + sine_2,
                 cosines = snell * snell * speed_1 * speed_2;
    const double part = sum * (1 + sine_1 * sine_2) /
                        (sines * (speed_1 * speed_1 + speed_2 * speed_2 - cosines * speed_1 * speed_2));
    const double change = speed_2 - speed_1, tanh = change * part;
    const double time = std::abs(tanh) < 1e-3 ? thickness * part * (1 + tanh * tanh / 3)
                                              : std::atanh(tanh) * thickness / change;
    return {snell * thickness * sum / sines, time};
}

}  // namespace echoloop
