#include "emulator/devices/family/multibeam_bottom.h"

#include <algorithm>
#include <cmath>

namespace echoloop::multibeam {
namespace {

/// Bins [first, last) of the window that overlap the gate.
std::pair<std::size_t, std::size_t> gated_bins(const Shot& shot, TimeGate gate) {
    const auto bin_of = [&](double time) {
        const double bin = (time - shot.first_bin_time) / shot.bin_interval;
        return static_cast<std::size_t>(std::clamp(bin, 0.0, static_cast<double>(shot.bins)));
    };
    return {bin_of(gate.min), std::min(bin_of(gate.max) + 1, shot.bins)};
}

/// Half the number of bins over which the beam's echo from a flat bottom spreads at a two-way time; no less
/// than three pulses, so that speckle averages out.
std::size_t half_footprint(const Shot& shot, double angle, double time) {
    const double slant = time * shot.beam_width * std::abs(std::tan(angle));
    const double length = slant + 3 * std::max(shot.pulse_length, shot.bin_interval);
    return static_cast<std::size_t>(std::ceil(length / shot.bin_interval / 2));
}

/// The bins [first, last) of a beam, each the mean over the footprint around it.
std::vector<float> over_footprints(const Shot& shot, std::span<const float> beam, double angle,
                                   std::size_t first, std::size_t last) {
    std::vector<double> sum(last - first + 1);
    for (std::size_t bin = first; bin < last; ++bin) sum[bin - first + 1] = sum[bin - first] + beam[bin];
    std::vector<float> mean(last - first);
    for (std::size_t i = 0; i < mean.size(); ++i) {
        const double time = shot.first_bin_time + static_cast<double>(first + i) * shot.bin_interval;
        const std::size_t half = half_footprint(shot, angle, time);
        const std::size_t from = i - std::min(i, half), to = std::min(i + half + 1, mean.size());
        mean[i] = static_cast<float>((sum[to] - sum[from]) / static_cast<double>(2 * half + 1));
    }
    return mean;
}

/// The run around the peak within 10 dB of it and clear of the noise: the beam's footprint on the bottom.
std::pair<std::size_t, std::size_t> run_around(const std::vector<float>& mean, std::size_t peak,
                                               double noise_power) {
    const double floor = std::max(mean[peak] / 10.0, 2 * noise_power);
    std::size_t from = peak, to = peak + 1;
    while (from > 0 && mean[from - 1] > floor) --from;
    while (to < mean.size() && mean[to] > floor) ++to;
    return {from, to};
}

/// Middle of the echo weighted by power above the noise, as two-way time.
double centre_time(const Echogram& echogram, std::span<const float> beam, std::size_t from, std::size_t to) {
    double weight = 0, moment = 0;
    for (std::size_t bin = from; bin < to; ++bin) {
        const double power = std::max(beam[bin] - echogram.noise_power, 0.0);
        weight += power;
        moment += power * (static_cast<double>(bin) + 0.5);
    }
    return echogram.shot.first_bin_time + echogram.shot.bin_interval * moment / weight;
}

/// Least power of a bottom; the paper's rule has neither power nor noise.
double least_power(const Echogram& echogram, double margin) {
    constexpr double least_of_paper = 0.05;
    if (echogram.rule == EchoRule::cerqueira2016) return least_of_paper;
    return echogram.noise_power * std::pow(10.0, margin / 10);
}

Detection detect_in(const Echogram& echogram, std::size_t index, TimeGate gate, const Rule& rule) {
    const Shot& shot = echogram.shot;
    const auto beam = echogram.beam(index);
    const auto [first, last] = gated_bins(shot, gate);
    if (first >= last) return {};
    const auto mean = over_footprints(shot, beam, shot.bearings[index], first, last);
    const auto peak = static_cast<std::size_t>(std::max_element(mean.begin(), mean.end()) - mean.begin());
    const double least = least_power(echogram, rule.margin);
    if (!(mean[peak] > least)) return {};
    const auto [from, to] = run_around(mean, peak, echogram.noise_power);
    Detection detection;
    detection.time = centre_time(echogram, beam, first + from, first + to);
    detection.power = *std::max_element(beam.begin() + first + from, beam.begin() + first + to);
    detection.excess = level_db(static_cast<float>(mean[peak] / least));
    // Interferometry needs an echo that is long against the pulse: the outer beams.
    const auto half = half_footprint(shot, shot.bearings[index], detection.time);
    const double length =
        (static_cast<double>(to - from) - 2 * static_cast<double>(half)) * shot.bin_interval;
    const bool by_phase = length > 4 * std::max(shot.pulse_length, shot.bin_interval);
    detection.method = by_phase ? Method::phase : Method::magnitude;
    if (rule.echoes_last) detection.time = std::max(0.0, detection.time - shot.pulse_length / 2);
    return detection;
}

}  // namespace

TimeGate time_gate(const Gates& gates, double angle, double sound_speed, double window) {
    TimeGate gate{0, window};
    if (gates.depth) {
        // A plane at depth d that slopes by s: the ray at `angle` meets it at d cos s / cos(angle - s).
        const double slope = gates.depth->slope;
        const double to_slant = std::cos(slope) / std::max(std::cos(angle - slope), 0.05);
        gate = {2 * gates.depth->min * to_slant / sound_speed, 2 * gates.depth->max * to_slant / sound_speed};
    }
    if (gates.range) {
        gate.min = std::max(gate.min, 2 * gates.range->min / sound_speed);
        gate.max = std::min(gate.max, 2 * gates.range->max / sound_speed);
    }
    return gate;
}

std::vector<Detection> detect(const Echogram& echogram, std::span<const TimeGate> gates, const Rule& rule) {
    std::vector<Detection> detections(std::min(echogram.beams(), gates.size()));
    for (std::size_t n = 0; n < detections.size(); ++n)
        detections[n] = detect_in(echogram, n, gates[n], rule);
    return detections;
}

double median_depth(std::span<const Detection> detections, std::span<const double> angles,
                    double sound_speed) {
    std::vector<double> depths;
    for (std::size_t n = 0; n < detections.size(); ++n)
        if (detections[n].found() && std::abs(angles[n]) < deg_to_rad(30))
            depths.push_back(detections[n].time * sound_speed / 2 * std::cos(angles[n]));
    if (depths.empty()) return 0;
    const auto middle = depths.begin() + static_cast<std::ptrdiff_t>(depths.size() / 2);
    std::nth_element(depths.begin(), middle, depths.end());
    return *middle;
}

}  // namespace echoloop::multibeam
