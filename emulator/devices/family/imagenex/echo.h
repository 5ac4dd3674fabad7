// Received levels to the echo data and the profile range of an Imagenex reply. Pure functions; know no time.
#pragma once

#include <cstdint>
#include <vector>

#include "emulator/devices/family/imagenex/settings.h"
#include "protocols/imagenex/messages.h"
#include "render/echogram.h"

namespace echoloop::imagenex_head {

/// How a reply carries its echo data; no points: profile range only.
struct Format {
    imagenex::Kind kind = imagenex::Kind::imx;
    std::size_t points = 0;
    int bits = 8;  ///< 4, 8 or 16
    std::size_t bytes = 0;
};
Format format_of(const imagenex::SwitchCommand& command, const Settings& settings);

/// How finely a ping is heard: `bins` over the range, `per_point` of them for each point.
struct Sampling {
    std::size_t bins = 1, per_point = 1;
};
/// `resolution` in m, as fine as the profile range is told.
Sampling sampling_of(const Format& format, double range, double resolution);

/// Sets the range window, the samples and everything that the profile says of a ping.
Shot plain_shot(const imagenex::SwitchCommand& command, const Format& format, double resolution,
                const Settings& settings);

/// Received amplitude after all gains, as part of the full scale and not cut: one per sample.
std::vector<double> amplitudes(const Echogram& echogram, const imagenex::SwitchCommand& command,
                               const Settings& settings);

/// The echo data of the amplitudes of all samples.
std::vector<std::uint8_t> echo_data(const std::vector<double>& samples, const Format& format,
                                    const Settings& settings);

/// m, by the head's own sound speed: where the samples first exceed the threshold; 0 if nowhere.
double profile_range(const std::vector<double>& samples, const imagenex::SwitchCommand& command,
                     const Settings& settings);

}  // namespace echoloop::imagenex_head
