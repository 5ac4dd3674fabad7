#include "emulator/devices/r2sonic/bottom.h"

#include <algorithm>
#include <cmath>

namespace echoloop::r2sonic_device {
namespace {

namespace quality = r2sonic::quality;

/// Bins [first, last) of the window that overlap the gate.
std::pair<std::size_t, std::size_t> gated_bins(const Shot& shot, TimeGate gate) {
    const auto bin_of = [&](double time) {
        const double bin = (time - shot.first_bin_time) / shot.bin_interval;
        return static_cast<std::size_t>(std::clamp(bin, 0.0, static_cast<double>(shot.bins)));
    };
    return {bin_of(gate.min), std::min(bin_of(gate.max) + 1, shot.bins)};
}

/// The run of bins around the peak within 10 dB of it: the beam's footprint on the bottom.
std::pair<std::size_t, std::size_t> footprint(std::span<const float> beam, std::size_t first,
                                              std::size_t last, std::size_t peak) {
    const float floor = beam[peak] / 10;
    std::size_t from = peak, to = peak + 1;
    while (from > first && beam[from - 1] > floor) --from;
    while (to < last && beam[to] > floor) ++to;
    return {from, to};
}

/// Middle of the footprint weighted by power, as two-way time.
double centre_time(const Shot& shot, std::span<const float> beam, std::size_t from, std::size_t to) {
    double weight = 0, moment = 0;
    for (std::size_t bin = from; bin < to; ++bin) {
        weight += beam[bin];
        moment += beam[bin] * (static_cast<double>(bin) + 0.5);
    }
    return shot.first_bin_time + shot.bin_interval * moment / weight;
}

}  // namespace

TimeGate beam_gate(const Controls& c, double angle, double sound_speed, double last_depth, double window) {
    TimeGate gate{0, window};
    double min = c.gate_min, max = c.gate_max;
    const std::uint32_t mode = c.gate_mode & 0xFF;
    const bool automatic = mode == 2 || mode == 3;
    if (automatic) {
        const double part = std::clamp<double>(c.gate_mode >> 8, 5, 90) / 100;
        min = last_depth * (1 - part);
        max = last_depth * (1 + part);
    }
    if (mode == 1 || (automatic && last_depth > 0)) {
        // A plane at depth d that slopes by s: the ray at `angle` meets it at d cos s / cos(angle - s).
        const double slope = automatic ? 0 : c.gate_slope;
        const double to_slant = std::cos(slope) / std::max(std::cos(angle - slope), 0.05);
        gate = {2 * min * to_slant / sound_speed, 2 * max * to_slant / sound_speed};
    }
    if (c.range_gate) {
        gate.min = std::max(gate.min, 2 * c.range_gate_min / sound_speed);
        gate.max = std::min(gate.max, 2 * c.range_gate_max / sound_speed);
    }
    return gate;
}

Detection detect(const Echogram& echogram, std::size_t index, TimeGate gate, float threshold) {
    const auto beam = echogram.beam(index);
    const auto [first, last] = gated_bins(echogram.shot, gate);
    if (first >= last) return {};
    const auto peak =
        static_cast<std::size_t>(std::max_element(beam.begin() + first, beam.begin() + last) - beam.begin());
    if (!(beam[peak] > threshold)) return {};
    const auto [from, to] = footprint(beam, first, last, peak);
    Detection detection;
    detection.time = centre_time(echogram.shot, beam, from, to);
    detection.power = beam[peak];
    // Interferometry needs an echo that is long against the pulse: the outer beams.
    const double length = static_cast<double>(to - from) * echogram.shot.bin_interval;
    const bool by_phase = length > 4 * std::max(echogram.shot.pulse_length, 1 / 65280.0);
    detection.quality = quality::brightness | quality::colinearity;
    detection.quality |= by_phase ? quality::phase : quality::magnitude;
    return detection;
}

double median_depth(const std::vector<Detection>& detections, const std::vector<double>& angles,
                    double sound_speed) {
    std::vector<double> depths;
    for (std::size_t n = 0; n < detections.size(); ++n)
        if (detections[n].quality != 0 && std::abs(angles[n]) < deg_to_rad(30))
            depths.push_back(detections[n].time * sound_speed / 2 * std::cos(angles[n]));
    if (depths.empty()) return 0;
    const auto middle = depths.begin() + static_cast<std::ptrdiff_t>(depths.size() / 2);
    std::nth_element(depths.begin(), middle, depths.end());
    return *middle;
}

}  // namespace echoloop::r2sonic_device
