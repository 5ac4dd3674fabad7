// How often Teledyne's Doppler logs ping.
#pragma once

namespace echoloop::doppler {

/// s from ping to ping at an altitude of so many m. Wayfinder DVL Guide 95P-6001-00, page 14: its table has
/// 55 ms at 5 m, while its printed 0.42e-3 s per m is shorter than the sound's way; ten times that fits the
/// table. A guess for the other models.
constexpr double teledyne_period(double altitude) { return 0.03 + 4.2e-3 * altitude; }

}  // namespace echoloop::doppler
