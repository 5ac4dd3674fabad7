#include "emulator/devices/family/multibeam/bottom.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "emulator/devices/family/multibeam/ring.h"
#include "emulator/devices/family/multibeam/stretches.h"
#include "emulator/devices/family/sounder/water.h"

namespace echoloop::multibeam {
namespace {

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

struct BinRange {
    std::size_t from = 0, to = 0;  ///< `to` is the first one behind
};

/// The loudest stretch of so many bins: an echo by itself, without what trails behind it.
BinRange loudest(std::span<const float> beam, BinRange within, std::size_t bins) {
    bins = std::min(bins, within.to - within.from);
    double sum = 0, most = -1;
    BinRange best = within;
    for (std::size_t end = within.from; end < within.to; ++end) {
        sum += beam[end];
        if (end + 1 < within.from + bins) continue;
        if (sum > most) most = sum, best = {end + 1 - bins, end + 1};
        sum -= beam[end + 1 - bins];
    }
    return best;
}

/// An echo by its power above the noise, in bins.
struct Extent {
    double centre = 0;
    double length = 0;  ///< of an even echo with the same second moment
    float peak = 0;     ///< uPa^2
};

Extent measure(const Echogram& echogram, std::size_t index, BinRange bins) {
    const auto beam = echogram.beam(index);
    double weight = 0, moment = 0, second = 0;
    Extent extent;
    for (std::size_t bin = bins.from; bin < bins.to; ++bin) {
        const double power = std::max(beam[bin] - echogram.noise_power, 0.0);
        const double at = static_cast<double>(bin - bins.from) + 0.5;
        weight += power;
        moment += power * at;
        second += power * at * at;
        extent.peak = std::max(extent.peak, beam[bin]);
    }
    const double centre = moment / weight;
    extent.centre = static_cast<double>(bins.from) + centre;
    extent.length = std::sqrt(12 * std::max(0.0, second / weight - centre * centre));
    return extent;
}

/// How many beams on either side share an echo with this one, as many on both: those within a beam width, and
/// half a degree more at most, since the bottom's echo is a curve over wide fans.
std::size_t neighbours(const Shot& shot, std::size_t index) {
    const auto& bearings = shot.bearings;
    const double reach = shot.beam_width + std::min(shot.beam_width, deg_to_rad(0.5));
    const std::size_t most = std::min(index, bearings.size() - 1 - index);
    std::size_t side = std::min<std::size_t>(most, 1);
    while (side < most && bearings[index + side + 1] - bearings[index] < reach &&
           bearings[index] - bearings[index - side - 1] < reach)
        ++side;
    return side;
}

/// Work memory of axis_crossing(), one number a bin.
struct Room {
    std::vector<double> powers, moments;
};

/// Bins from the transmission to that one.
double bins_until(const Shot& shot, double bin) { return shot.first_bin_time / shot.bin_interval + bin; }

/// A line through the direction that each bin's power comes from. A straight bottom's directions lie evenly
/// over 1 / time; over time they bend so much that wide beams would see the bottom too deep.
class DirectionLine {
  public:
    /// `first`: the first bin, from the middle of the echo; `whole`: bins from the transmission to that
    /// middle.
    DirectionLine(const Room& room, double first, double whole) : room_(room), first_(first), whole_(whole) {}

    /// Where it passes the axis, bins from the middle of the echo, if it does; of the bins within from..to.
    std::optional<double> crossing(double from, double to) const {
        const double last = static_cast<double>(room_.powers.size()) - 1;
        const auto begin = static_cast<std::size_t>(std::clamp(std::ceil(from - first_), 0.0, last));
        const auto end = static_cast<std::size_t>(std::clamp(std::floor(to - first_), 0.0, last)) + 1;
        const Sums sums = sums_of(begin, end);
        const double spread = sums.weight * sums.times - sums.time * sums.time;
        const double slope = sums.weight * sums.both - sums.time * sums.angle;
        if (!(spread > 0) || slope == 0) return std::nullopt;
        const double crossing = sums.time / sums.weight - sums.angle / sums.weight * spread / slope;
        return crossing < whole_ / 2 ? std::optional(crossing * whole_ / (whole_ - crossing)) : std::nullopt;
    }

  private:
    struct Sums {
        double weight = 0, time = 0, angle = 0, times = 0, both = 0;
        void add(const Sums& other) {
            weight += other.weight, time += other.time, angle += other.angle;
            times += other.times, both += other.both;
        }
    };
    Sums sums_of(std::size_t begin, std::size_t end) const {
        constexpr std::size_t lanes = 4;  // none of which waits for the sums of another
        Sums sums[lanes];
        const double part = 1 / whole_;
        std::size_t i = begin;
        const auto add = [&](std::size_t bin, Sums& sum) {
            const double bins = first_ + static_cast<double>(bin), x = bins * part;
            const double at = bins * (1 - x * (1 - x));  // bins / (1 + x), near enough
            const double power = room_.powers[bin], moment = room_.moments[bin];
            sum.weight += power, sum.time += power * at, sum.times += power * at * at;
            sum.angle += moment, sum.both += moment * at;
        };
        for (; i + lanes <= end; i += lanes)
            for (std::size_t k = 0; k < lanes; ++k) add(i + k, sums[k]);
        for (; i < end; ++i) add(i, sums[0]);
        for (std::size_t k = 1; k < lanes; ++k) sums[0].add(sums[k]);
        return sums[0];
    }

    const Room& room_;
    double first_, whole_;
};

/// Bin where an echo passes the beam's axis: a line through the direction that each bin's power comes from,
/// as the beams around share it, which stands for the phase between the halves of an array. Nothing if it
/// does not pass within the echo. The outermost beams lack neighbours and take the
/// middle until continue_to_edges().
std::optional<double> axis_crossing(const Echogram& echogram, std::size_t index, BinRange bins,
                                    const Extent& extent, Room& room) {
    const std::size_t side = neighbours(echogram.shot, index);
    if (side == 0) return extent.centre;
    bins.from = std::max(bins.from, static_cast<std::size_t>(std::max(0.0, extent.centre - extent.length)));
    bins.to = std::min(bins.to, static_cast<std::size_t>(extent.centre + extent.length) + 1);
    const auto& bearings = echogram.shot.bearings;
    const auto noise = static_cast<float>(echogram.noise_power);
    const std::size_t count = bins.to - bins.from;
    std::vector<double>&powers = room.powers, &moments = room.moments;
    powers.assign(count, 0), moments.assign(count, 0);
    for (std::size_t beam = index - side; beam <= index + side; ++beam) {
        const float* levels = echogram.beam(beam).data() + bins.from;
        const double off = bearings[beam] - bearings[index];
        for (std::size_t i = 0; i < count; ++i) {
            const double echo = std::max(levels[i] - noise, 0.0F);
            powers[i] += echo;
            moments[i] += echo * off;
        }
    }
    const DirectionLine line{room, static_cast<double>(bins.from) + 0.5 - extent.centre,
                             bins_until(echogram.shot, extent.centre)};
    // First by the whole echo, then by what is near the axis: behind it are side lobes along the track, too.
    const double half = std::max(2.0, extent.length / 2);
    double crossing = 0;
    for (const double reach : {2 * half, half}) {
        const auto found = line.crossing(crossing - reach, crossing + reach);
        if (!found || !(std::abs(*found) < extent.length / 2)) return std::nullopt;
        crossing = *found;
    }
    return extent.centre + crossing;
}

/// Echoes that measure less than so many times the resolution are little more than one pulse. Fit: with it
/// soundings scatter towards the nadir as those of a real Sonic 2026 do (docs/validation.md).
constexpr double one_pulse = 2.8;

/// Where such an echo is strongest, in bins from the start: no shape of its own tells its middle, so speckle
/// moves it within the pulse. What is near the peak counts, so that a flat top has its middle.
double strongest_place(std::span<const float> beam, BinRange echo, float peak) {
    double weight = 0, moment = 0;
    for (std::size_t bin = echo.from; bin < echo.to; ++bin) {
        const double part = beam[bin] / peak, cube = part * part * part;
        weight += cube * cube;
        moment += cube * cube * (static_cast<double>(bin) + 0.5);
    }
    return moment / weight;
}

/// By which part of its time a level bottom's echo comes too late, since the fan has a height h: at an angle
/// x along the track the bottom is x^2 / 2 farther. The side lobes of a line, sinc^2(0.886 x / h), leave as
/// much of that in every equal part of x, as far as the echo lasts.
double lateness(const Shot& shot, const Extent& extent) {
    constexpr double of_main_lobe = 0.09;  // half the variance of a Gaussian of width 1
    if (shot.vertical.shape != ApertureShape::line || shot.vertical.ways != 1)
        return of_main_lobe * shot.fan_height * shot.fan_height;
    const double farthest = std::sqrt(extent.length / bins_until(shot, extent.centre));
    return shot.fan_height * farthest / (2 * std::numbers::pi * std::numbers::pi * 0.886);
}

/// Least power of a bottom; the paper's rule has neither power nor noise.
double least_power(const Echogram& echogram, double margin) {
    constexpr double least_of_paper = 0.05;
    if (echogram.rule == EchoRule::cerqueira2016) return least_of_paper;
    return echogram.noise_power * std::pow(10.0, margin / 10);
}

constexpr double slack =
    1.3;  // times the length that an echo should have; own choice, least scatter of 1, 1.3, 2

Detection detect_in(const Echogram& echogram, std::size_t index, TimeGate gate, const Rule& rule,
                    std::span<const float> heard, Stretches& stretches, Room& room) {
    const Shot& shot = echogram.shot;
    gate.min = std::max(gate.min, 2 * rule.nearest / echogram.sound_speed);
    const auto [first, last] = gated_bins(shot, gate);
    if (first >= last) return {};
    stretches.start(echogram, index, first, last, heard);
    const double least = least_power(echogram, rule.margin);
    const std::size_t peak = stretches.peak(least);
    if (!(stretches.mean(peak) > least &&
          echosounder::stands_out_of_water(echogram, index, first + peak, stretches.mean(peak),
                                           echosounder::footprint_margin)))
        return {};
    const auto [from, to] = stretches.run_around(peak, echogram.noise_power);
    const BinRange run{first + from, first + to};
    const double expected = stretches.longest_footprint(peak) + resolution(shot) / shot.bin_interval;
    const BinRange echo = loudest(echogram.beam(index), run, static_cast<std::size_t>(slack * expected) + 2);
    Extent extent = measure(echogram, index, echo);
    if (!(extent.peak > 0) || !std::isfinite(extent.centre)) return {};
    const double pulses = extent.length * shot.bin_interval / resolution(shot);
    if (pulses < one_pulse) extent.centre = strongest_place(echogram.beam(index), echo, extent.peak);
    // Interferometry needs an echo that is long against the pulse: the outer beams.
    std::optional<double> crossing;
    if (pulses > rule.phase_length) crossing = axis_crossing(echogram, index, run, extent, room);
    const auto time_of = [&](double bin) { return shot.first_bin_time + bin * shot.bin_interval; };
    const double delay = echo_delay(shot, rule.echoes_last);
    Detection detection;
    const double early = 1 / (1 + lateness(shot, extent));
    detection.time = std::max(0.0, early * (time_of(crossing.value_or(extent.centre)) - delay));
    detection.begin = std::max(0.0, time_of(static_cast<double>(run.from)));
    detection.end = time_of(static_cast<double>(run.to));
    detection.power = extent.peak;
    detection.mean = static_cast<float>(stretches.mean(peak));
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
    Room room;
    const SideLobes lobes(echogram);
    for (std::size_t n = 0; n < detections.size(); ++n)
        detections[n] = detect_in(echogram, n, gates[n], rule, lobes.likely(), stretches, room);
    const std::vector<float> anything(echogram.shot.bins, 0.0F);
    const auto above_possible = [&](std::size_t n) {
        return detect_in(echogram, n, gates[n], rule, lobes.possible(), stretches, room);
    };
    const auto within = [&](std::size_t n, TimeGate near) {
        near = {std::max(near.min, gates[n].min), std::min(near.max, gates[n].max)};
        return detect_in(echogram, n, near, rule, anything, stretches, room);
    };
    lobes.leave_out(detections, {above_possible, within});
    continue_to_edges(detections, echogram.shot.bearings, echogram.shot.beam_width);
    move_to_neighbours(detections, echogram.shot.bearings, echogram.shot.beam_width);
    smooth_by_phase(detections, echogram.shot.bearings, rule.smoothed);
    mark_in_line(detections, echogram.shot.bearings);
    return detections;
}

}  // namespace echoloop::multibeam
