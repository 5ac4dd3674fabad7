#include "emulator/devices/family/multibeam/ring.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "render/simd.h"

namespace echoloop::multibeam {
namespace {

constexpr double design = 1e-4,
                 shaded = 0.75;   // mean floor of a perfect array, N_eff / N; own choice of both
constexpr double above_mean = 5;  // 7 dB: the highest lobe of a unit
/// A lobe's power and the speckle that it hears are exponential both: their product exceeds 60 times the mean
/// once in a million. Many directions together bring twice theirs at most.
constexpr double highest = 60, together = 2;
constexpr double tolerance = 0.02;  // of the time, as mark_in_line() has it
/// Beams between the sure ones beside a hole of the speckle: over a hole the others hear little, too. Own
/// choice.
constexpr std::size_t widest_hole = 20;
constexpr std::ptrdiff_t farthest = 40;  // beams: neighbours beyond tell nothing; own choice

/// Of a fan's beams that hear one direction, the share that is one beam's.
double share_of_one(const Shot& shot) {
    const auto steps = static_cast<double>(shot.bearings.size() - 1);
    return std::min(1.0, (shot.bearings.back() - shot.bearings.front()) / steps / shot.beam_width);
}

/// Two-way time at which the beam at `angle` meets the line through what two others found; 0 if it does not.
double time_in_line(double time_a, double angle_a, double time_b, double angle_b, double angle) {
    const double between = time_a * time_b * std::sin(angle_b - angle_a);
    const double facing = time_a * std::sin(angle - angle_a) + time_b * std::sin(angle_b - angle);
    return facing > 0 ? between / facing : 0;
}

/// The sure beams next to one on a side, the nearest first; as many as there are, two at most.
std::vector<std::size_t> sure_beside(std::span<const char> sure, std::size_t own, std::ptrdiff_t way) {
    std::vector<std::size_t> found;
    for (std::ptrdiff_t step = 1; step <= farthest && found.size() < 2; ++step) {
        const std::ptrdiff_t n = static_cast<std::ptrdiff_t>(own) + way * step;
        if (n < 0 || n >= static_cast<std::ptrdiff_t>(sure.size())) break;
        if (sure[static_cast<std::size_t>(n)]) found.push_back(static_cast<std::size_t>(n));
    }
    return found;
}

/// Adds some beams, which lie behind each other, to the sum of all, one after the other, and finds the
/// greatest of them.
template <std::size_t beams>
ECHOLOOP_INLINE void add_beams(const float* __restrict levels, std::size_t bins, float* __restrict sum,
                               float* __restrict most) {
    for (std::size_t bin = 0; bin < bins; ++bin) {
        float all = sum[bin], greatest = most[bin];
#pragma GCC unroll 4
        for (std::size_t beam = 0; beam < beams; ++beam) {
            const float level = levels[beam * bins + bin];
            all += level, greatest = std::max(greatest, level);
        }
        sum[bin] = all, most[bin] = greatest;
    }
}

/// The sum of all beams, and the greatest of them. Several at once: the sums are in the nearest cache, but as
/// long to read as the levels.
ECHOLOOP_SIMD
void add_levels(const float* levels, std::size_t beams, std::size_t bins, float* sum, float* most) {
    constexpr std::size_t at_once = 4;
    std::size_t beam = 0;
    for (; beam + at_once <= beams; beam += at_once)
        add_beams<at_once>(levels + beam * bins, bins, sum, most);
    for (; beam < beams; ++beam) add_beams<1>(levels + beam * bins, bins, sum, most);
}

}  // namespace

SideLobes::SideLobes(const Echogram& echogram)
    : shot_(echogram.shot), likely_(shot_.bins, 0.0F), possible_(shot_.bins, 0.0F) {
    if (shot_.bearings.size() < 2) return;
    const double amplitude = shot_.errors.amplitude / 8.686, phase = shot_.errors.phase;
    const double floor = design + (amplitude * amplitude + phase * phase) / (shaded * shot_.receiver.staves);
    add_levels(echogram.values.data(), echogram.beams(), shot_.bins, likely_.data(), possible_.data());
    const auto all = static_cast<float>(floor * share_of_one(shot_)), one = static_cast<float>(floor);
    for (std::size_t bin = 0; bin < likely_.size(); ++bin) {
        const float mean = all * likely_[bin], loudest = one * possible_[bin];
        likely_[bin] = static_cast<float>(above_mean) * mean;
        possible_[bin] = std::max(
            likely_[bin], static_cast<float>(together) * mean + static_cast<float>(highest) * loudest);
    }
}

void SideLobes::leave_out(std::span<Detection> detections, const Searches& again) const {
    std::vector<char> sure(detections.size());
    for (std::size_t n = 0; n < detections.size(); ++n)
        sure[n] = detections[n].found() && detections[n].mean >= possible_in(detections[n]);
    const auto& angles = shot_.bearings;
    for (std::size_t n = 0; n < detections.size(); ++n) {
        if (sure[n]) continue;
        const auto port = sure_beside(sure, n, -1), starboard = sure_beside(sure, n, 1);
        std::vector<std::size_t> beside(port.rbegin(), port.rend());
        beside.insert(beside.end(), starboard.begin(), starboard.end());
        const auto expected_between = [&](std::size_t a, std::size_t b) {
            return time_in_line(detections[a].time, angles[a], detections[b].time, angles[b], angles[n]);
        };
        // How far a time is off what the neighbours let expect, as a part of it; infinite without neighbours.
        const auto off = [&](double time) {
            double least = std::numeric_limits<double>::infinity();
            for (std::size_t i = 0; i + 1 < beside.size(); ++i) {
                const std::size_t a = beside[i], b = beside[i + 1];
                const double one = detections[a].time, other = detections[b].time;
                least = std::min(least, std::abs(expected_between(a, b) / time - 1));
                if (a < n && n < b && std::min(one, other) <= time && time <= std::max(one, other)) least = 0;
            }
            return least;
        };
        const bool found = detections[n].found();
        const double own = found ? off(detections[n].time) : std::numeric_limits<double>::infinity();
        if (own < tolerance) continue;
        if (!port.empty() && !starboard.empty() && starboard[0] - port[0] <= widest_hole) {
            const double expected = expected_between(port[0], starboard[0]);
            const Detection near = again.within(n, {expected * (1 - tolerance), expected * (1 + tolerance)});
            if (near.found() && off(near.time) < tolerance) {
                detections[n] = near;
                continue;
            }
        }
        if (!found) continue;
        const Detection other = again.above_possible(n);
        if (!other.found() || off(other.time) < own) detections[n] = other;
    }
}

double SideLobes::possible_in(const Detection& detection) const {
    const auto bin_of = [&](double time) {
        const double bin = (time - shot_.first_bin_time) / shot_.bin_interval;
        return static_cast<std::size_t>(std::clamp(bin, 0.0, static_cast<double>(shot_.bins - 1)));
    };
    const std::size_t from = bin_of(detection.begin), to = bin_of(detection.end) + 1;
    double sum = 0;
    for (std::size_t bin = from; bin < to; ++bin) sum += possible_[bin];
    return sum / static_cast<double>(to - from);
}

}  // namespace echoloop::multibeam
