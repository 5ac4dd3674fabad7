#include "emulator/devices/family/multibeam_bottom.h"

#include <algorithm>
#include <cmath>

namespace echoloop::multibeam {
namespace {

/// Length of the pulse, s, of a chirp after compression.
double pulse_length(const Shot& shot) { return shot.bandwidth > 0 ? 1 / shot.bandwidth : shot.pulse_length; }

/// Shortest time that the receiver tells apart, s.
double resolution(const Shot& shot) {
    const double band = shot.receiver.bandwidth > 0 ? 1 / shot.receiver.bandwidth : 0;
    return std::max({pulse_length(shot), band, shot.bin_interval});
}

/// By how much the middle of an echo comes after the bottom: half the pulse, and what the receiver's band
/// adds. A compressed chirp lies around its range.
double echo_delay(const Shot& shot, bool echoes_last) {
    if (!echoes_last || shot.bandwidth > 0) return 0;
    const double half = shot.pulse_length / 2;
    return half + std::min(half, shot.receiver.bandwidth > 0 ? 0.25 / shot.receiver.bandwidth : half / 2);
}

/// Bins [first, last) of the window that overlap the gate.
std::pair<std::size_t, std::size_t> gated_bins(const Shot& shot, TimeGate gate) {
    const auto bin_of = [&](double time) {
        const double bin = (time - shot.first_bin_time) / shot.bin_interval;
        return static_cast<std::size_t>(std::clamp(bin, 0.0, static_cast<double>(shot.bins)));
    };
    return {bin_of(gate.min), std::min(bin_of(gate.max) + 1, shot.bins)};
}

/// Sums of a beam's bins, for means over stretches of it.
class Stretches {
  public:
    /// The bins [first, last) of beam `index`.
    void start(const Echogram& echogram, std::size_t index, std::size_t first, std::size_t last) {
        const Shot& shot = echogram.shot;
        const auto beam = echogram.beam(index).subspan(first, last - first);
        sum_.resize(beam.size() + 1);
        add_up(beam);
        // A flat bottom's echo lasts t * beam width * tan(angle); three pulses at least, so that speckle
        // averages.
        slope_ = shot.beam_width * std::abs(std::tan(shot.bearings[index])) / 2;
        const double pulses = 3 * std::max(pulse_length(shot), shot.bin_interval);
        const double before = shot.first_bin_time / shot.bin_interval + static_cast<double>(first);
        first_half_ = pulses / 2 / shot.bin_interval + before * slope_;
    }
    std::size_t size() const { return sum_.size() - 1; }
    /// Half the bins of a footprint around bin `i`.
    std::size_t half(std::size_t i) const {
        return static_cast<std::size_t>(first_half_ + slope_ * static_cast<double>(i)) + 1;
    }
    /// Mean over the footprint around bin `i`.
    double mean(std::size_t i) const {
        const std::size_t h = half(i);
        const std::size_t from = i - std::min(i, h), to = std::min(i + h + 1, size());
        return (sum_[to] - sum_[from]) / static_cast<double>(2 * h + 1);
    }
    /// Bin around which the mean is greatest: found at a coarse step, then nearby.
    std::size_t peak() const {
        Best best;
        for (std::size_t i = 0; i < size();) i = look(i, size(), std::max<std::size_t>(1, half(i) / 4), best);
        const std::size_t near = half(best.bin) / 4, from = best.bin - std::min(best.bin, near);
        const std::size_t end = std::min(best.bin + near + 1, size());
        for (std::size_t i = from; i < end;) i = look(i, end, 1, best);
        return best.bin;
    }
    /// The run around a peak within 10 dB of it and clear of the noise.
    std::pair<std::size_t, std::size_t> run_around(std::size_t peak, double noise_power) const {
        const double floor = std::max(mean(peak) / 10.0, 2 * noise_power);
        std::size_t from = peak, to = peak + 1;
        while (from > 0 && mean(from - 1) > floor) --from;
        while (to < size() && mean(to) > floor) ++to;
        return {from, to};
    }

  private:
    struct Best {
        std::size_t bin = 0;
        double mean = -1;
    };

    /// Every `step`th bin from `i` on, as long as the footprint has the same number of bins; where it went on
    /// to.
    std::size_t look(std::size_t i, std::size_t end, std::size_t step, Best& best) const {
        const std::size_t h = half(i);
        const double until = slope_ > 0 ? std::ceil((static_cast<double>(h) - first_half_) / slope_) : 1e9;
        const std::size_t same = std::clamp(static_cast<std::size_t>(std::min(until, 1e9)), i + 1, end);
        const double weight = 1 / static_cast<double>(2 * h + 1);
        for (; i < same; i += step) {
            const std::size_t from = i > h ? i - h : 0, to = std::min(i + h + 1, size());
            const double value = (sum_[to] - sum_[from]) * weight;
            if (value > best.mean) best = {i, value};
        }
        return i;
    }

    /// Four quarters at a time: one sum would wait for itself at every bin.
    void add_up(std::span<const float> beam) {
        const std::size_t quarter = beam.size() / 4;
        double sums[4] = {};
        for (std::size_t i = 0; i < quarter; ++i)
            for (std::size_t q = 0; q < 4; ++q) sum_[q * quarter + i + 1] = sums[q] += beam[q * quarter + i];
        double before = sum_[0] = 0;
        for (std::size_t q = 1; q < 4; ++q) {
            before += sums[q - 1];
            for (std::size_t i = 1; i <= quarter; ++i) sum_[q * quarter + i] += before;
        }
        for (std::size_t i = 4 * quarter; i < beam.size(); ++i) sum_[i + 1] = sum_[i] + beam[i];
    }

    std::vector<double> sum_;
    double slope_ = 0, first_half_ = 0;
};

/// An echo by its power above the noise, in bins.
struct Extent {
    double centre = 0;
    double length = 0;  ///< of an even echo with the same second moment
    float peak = 0;     ///< uPa^2
};

Extent measure(const Echogram& echogram, std::size_t index, std::size_t from, std::size_t to) {
    const auto beam = echogram.beam(index);
    double weight = 0, moment = 0, second = 0;
    Extent extent;
    for (std::size_t bin = from; bin < to; ++bin) {
        const double power = std::max(beam[bin] - echogram.noise_power, 0.0);
        const double at = static_cast<double>(bin - from) + 0.5;
        weight += power;
        moment += power * at;
        second += power * at * at;
        extent.peak = std::max(extent.peak, beam[bin]);
    }
    const double centre = moment / weight;
    extent.centre = static_cast<double>(from) + centre;
    extent.length = std::sqrt(12 * std::max(0.0, second / weight - centre * centre));
    return extent;
}

/// Bin where an echo passes the beam's axis: a line through the balance of power between the beams on either
/// side, which stands for the phase between the halves of an array. Nothing if it does not pass within the
/// echo. The outermost beams lack such neighbours and take the middle.
std::optional<double> axis_crossing(const Echogram& echogram, std::size_t index, std::size_t from,
                                    std::size_t to, const Extent& extent) {
    if (index == 0 || index + 1 >= echogram.beams()) return extent.centre;
    const auto port = echogram.beam(index - 1), own = echogram.beam(index),
               starboard = echogram.beam(index + 1);
    const auto noise = static_cast<float>(echogram.noise_power);
    double weight = 0, time = 0, balance = 0, times = 0, both = 0;
    for (std::size_t bin = from; bin < to; ++bin) {
        const double p = std::max(port[bin] - noise, 0.0F), s = std::max(starboard[bin] - noise, 0.0F);
        const double sum = p + s + std::max(own[bin] - noise, 0.0F);
        const double at = static_cast<double>(bin) + 0.5 - extent.centre;
        weight += sum;
        time += sum * at;
        times += sum * at * at;
        balance += s - p;
        both += (s - p) * at;
    }
    const double spread = weight * times - time * time, slope = weight * both - time * balance;
    if (!(spread > 0) || slope == 0) return std::nullopt;
    const double crossing = time / weight - balance / weight * spread / slope;
    if (!(std::abs(crossing) < extent.length / 2)) return std::nullopt;
    return extent.centre + crossing;
}

/// Least power of a bottom; the paper's rule has neither power nor noise.
double least_power(const Echogram& echogram, double margin) {
    constexpr double least_of_paper = 0.05;
    if (echogram.rule == EchoRule::cerqueira2016) return least_of_paper;
    return echogram.noise_power * std::pow(10.0, margin / 10);
}

Detection detect_in(const Echogram& echogram, std::size_t index, TimeGate gate, const Rule& rule,
                    Stretches& stretches) {
    const Shot& shot = echogram.shot;
    const auto [first, last] = gated_bins(shot, gate);
    if (first >= last) return {};
    stretches.start(echogram, index, first, last);
    const std::size_t peak = stretches.peak();
    const double least = least_power(echogram, rule.margin);
    if (!(stretches.mean(peak) > least)) return {};
    const auto [from, to] = stretches.run_around(peak, echogram.noise_power);
    const Extent extent = measure(echogram, index, first + from, first + to);
    if (!(extent.peak > 0) || !std::isfinite(extent.centre)) return {};
    // Interferometry needs an echo that is long against the pulse: the outer beams.
    std::optional<double> crossing;
    if (extent.length * shot.bin_interval > rule.least_phase_length * resolution(shot))
        crossing = axis_crossing(echogram, index, first + from, first + to, extent);
    const auto time_of = [&](double bin) { return shot.first_bin_time + bin * shot.bin_interval; };
    const double delay = echo_delay(shot, rule.echoes_last);
    Detection detection;
    detection.time = std::max(0.0, time_of(crossing.value_or(extent.centre)) - delay);
    detection.begin = std::max(0.0, time_of(static_cast<double>(first + from)));
    detection.end = time_of(static_cast<double>(first + to));
    detection.power = extent.peak;
    detection.excess = level_db(static_cast<float>(stretches.mean(peak) / least));
    detection.method = crossing ? Method::phase : Method::magnitude;
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
    Stretches stretches;
    for (std::size_t n = 0; n < detections.size(); ++n)
        detections[n] = detect_in(echogram, n, gates[n], rule, stretches);
    mark_in_line(detections, echogram.shot.bearings);
    return detections;
}

}  // namespace echoloop::multibeam
