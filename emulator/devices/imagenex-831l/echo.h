// Received levels to the echo data and the profile range of an 831L. Pure functions; know no time.
#pragma once

#include <cstdint>
#include <vector>

#include "emulator/devices/imagenex-831l/settings.h"

namespace echoloop::imagenex831l {

/// Received amplitude after all gains, as part of the full scale and not cut: one per sample.
std::vector<double> amplitudes(const Echogram& echogram, const imagenex::SwitchCommand& command,
                               const Settings& settings);
/// The points of an IMX.
std::vector<std::uint8_t> echo_data(const std::vector<double>& samples, const Settings& settings);
/// m: where the samples first exceed the threshold, by the begin of that echo or by its middle less that of
/// the pulse; 0 if nowhere.
double profile_range(const std::vector<double>& samples, const imagenex::SwitchCommand& command,
                     const Settings& settings);
/// The same in the words of a reply.
imagenex::Packed14 profile_word(double range, const imagenex::SwitchCommand& command,
                                const Settings& settings);

}  // namespace echoloop::imagenex831l
