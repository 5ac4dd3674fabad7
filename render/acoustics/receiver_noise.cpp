#include "render/acoustics/receiver_noise.h"

#include <algorithm>
#include <cmath>

namespace echoloop {
namespace {

double from_db(double db) { return std::pow(10, db / 10); }

/// (0.54^2) / (0.54^2 + 0.46^2 / 2)
constexpr double hamming_share = 0.734;

}  // namespace

double thermal_noise_level(double frequency) { return -15 + 20 * std::log10(frequency / 1000); }

double noise_bandwidth(const Shot& shot) {
    if (shot.receiver.bandwidth > 0) return shot.receiver.bandwidth;
    if (shot.pulse_length > 0)
        return shot.bandwidth > 0 ? std::min(shot.bandwidth, 1 / shot.pulse_length) : 1 / shot.pulse_length;
    return shot.bandwidth > 0 ? shot.bandwidth : 1 / shot.bin_interval;
}

double received_noise(const Shot& shot) {
    const Receiver& receiver = shot.receiver;
    const double density = from_db(thermal_noise_level(shot.frequency)) + from_db(receiver.self_noise);
    return density * noise_bandwidth(shot) * from_db(-receiver.directivity_index);
}

double effective_staves(const Shot& shot) {
    const double share = shot.horizontal.shape == ApertureShape::hamming ? hamming_share : 1;
    return std::max(1.0, shot.receiver.staves * share);
}

double converter_step(const Shot& shot) {
    const Receiver& receiver = shot.receiver;
    if (receiver.converter_bits < 2 || !std::isfinite(receiver.saturation_level)) return 0;
    const double steps = std::exp2(receiver.converter_bits - 1) - 1;
    return from_db(receiver.saturation_level) / (steps * steps) / effective_staves(shot);
}

double converter_noise(const Shot& shot) { return converter_step(shot) / 12; }

}  // namespace echoloop
