// Received power to the results of a Cerulean profile, and the gain that suits them. Pure functions.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "render/echogram.h"

namespace echoloop::cerulean_device {

/// A profile as it travels: 0 is `min_db` and 65535 `max_db`, in dB of the converter's full scale at the gain
/// in use.
struct Results {
    std::vector<std::uint16_t> values;
    float min_db = 0, max_db = 0;
};

/// Each ping is spread over all of 0..65535, as in recordings of real units, at most 90 dB below its
/// strongest bin. `full_scale`: dB re 1 uPa that the converter just holds.
Results to_results(std::span<const float> powers, double full_scale);

/// Mean over `bins` neighbours, which lose themselves at the ends; 1 leaves the powers as they are.
std::vector<float> smoothed(std::span<const float> powers, std::size_t bins);

/// dB re 1 uPa that the converter just holds at each gain, the lowest first. `lowest`: at the lowest gain.
std::vector<double> full_scales(double lowest, std::span<const double> gains);
/// The highest gain at which the strongest of these echoes, kept 6 dB below full scale, would not clip.
/// `heard_with`: the gain of this ping; a clipped echo is stronger than it looks and lowers it by one at
/// least.
std::size_t fitting_gain(std::span<const float> powers, std::span<const double> full_scales,
                         std::size_t heard_with);

/// deg clockwise from north of a direction in the world; 0 straight up or down.
double compass(Vec3 direction);

}  // namespace echoloop::cerulean_device
