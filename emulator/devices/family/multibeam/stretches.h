// Means over stretches of a multibeam's beam that are as long as its footprint on a flat bottom, and where
// they are greatest. Of one beam at a time; it decides nothing about a bottom. What every bin passes through
// is in the header.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include "render/echogram.h"

namespace echoloop::multibeam {

/// Length of the pulse, s, of a chirp after compression.
inline double pulse_length(const Shot& shot) {
    return shot.bandwidth > 0 ? 1 / shot.bandwidth : shot.pulse_length;
}

/// Sums of a beam's bins, for means over stretches of it. Hardly any bin is asked for: a bottom is a small
/// part of a beam. So sums are made for blocks of bins, and for single ones when they are asked for.
class Stretches {
  public:
    /// The bins [first, last) of beam `index`; of those that lie below `least` (uPa^2, one a bin of the
    /// window), nothing counts.
    void start(const Echogram& echogram, std::size_t index, std::size_t first, std::size_t last,
               std::span<const float> least) {
        const Shot& shot = echogram.shot;
        add_up(echogram.beam(index).subspan(first, last - first), least.subspan(first, last - first));
        spreads_ = echogram.rule == EchoRule::radiometric;
        // A flat bottom's echo lasts t * beam width * tan(angle); three pulses at least, so that speckle
        // averages.
        const double angle = std::abs(shot.bearings[index]);
        slope_ = shot.beam_width * std::tan(angle) / 2;
        steep_ = shot.beam_width * std::tan(std::min(angle + deg_to_rad(30), deg_to_rad(85)));
        const double pulses = 3 * std::max(pulse_length(shot), shot.bin_interval);
        delay_ = shot.first_bin_time / shot.bin_interval + static_cast<double>(first);
        first_half_ = pulses / 2 / shot.bin_interval + delay_ * slope_;
    }
    std::size_t size() const { return size_; }
    /// Half the bins of a footprint around bin `i`.
    std::size_t half(std::size_t i) const {
        return static_cast<std::size_t>(first_half_ + slope_ * static_cast<double>(i)) + 1;
    }
    /// Bins that an infinitely short pulse's echo around bin `i` lasts at most, of a bottom that slopes by 30
    /// deg.
    double longest_footprint(std::size_t i) const { return steep_ * (delay_ + static_cast<double>(i)); }
    /// Mean over the footprint around bin `i`.
    double mean(std::size_t i) {
        const std::size_t h = half(i);
        const std::size_t from = i - std::min(i, h), to = std::min(i + h + 1, size());
        return (sum_to(to) - sum_to(from)) / static_cast<double>(2 * h + 1);
    }
    /// Bin around which the mean times the square of its time is greatest, the first of them, of those with a
    /// mean above `least` (uPa^2); 0 without one. So a head's time-varied gain compares them, which gives
    /// back what spreading takes: what floats right before the array is louder than a bottom far away.
    std::size_t peak(double least);
    /// The run around a peak within 10 dB of it and clear of the noise.
    std::pair<std::size_t, std::size_t> run_around(std::size_t peak, double noise_power) {
        const double floor = std::max(mean(peak) / 10.0, 2 * noise_power);
        std::size_t from = peak, to = peak + 1;
        while (from > 0 && mean(from - 1) > floor) --from;
        while (to < size() && mean(to) > floor) ++to;
        return {from, to};
    }

  private:
    /// What the gain of bin `i` makes of a power; the paper's rule has no spreading.
    double with_gain(double power, std::size_t i) const {
        if (!spreads_) return power;
        const double time = delay_ + static_cast<double>(i) + 0.5;
        return power * time * time;
    }
    /// The first bin behind `i` whose footprint is longer than that one's; size() without one.
    std::size_t next_length(std::size_t i) const;

    static constexpr std::size_t block = 64;  ///< bins that are added up together

    void add_up(std::span<const float> beam, std::span<const float> least);
    void add_bins_of(std::size_t number);
    /// Of the bins before `i`.
    double sum_to(std::size_t i) {
        if (!single_[i / block]) add_bins_of(i / block);
        return sum_[i];
    }
    /// No mean over `length` bins is greater, of those within the bins [from, to).
    double bound(std::size_t from, std::size_t to, std::size_t length) const;

    /// Bins with footprints of one length.
    struct Candidates {
        std::size_t begin, end, half;
        double most;  ///< no mean of them is greater, with the gain of the last
        std::size_t length() const { return 2 * half + 1; }
    };
    struct Loudest {
        std::size_t bin = 0;
        double gained = -1;
    };
    /// Whether the window cuts some of their footprints off.
    bool cuts(const Candidates& all) const { return all.begin < all.half || all.end + all.half > size(); }
    /// sum_ from where the first of their footprints begins until the last one's end; of footprints that are
    /// whole.
    const double* sums_of(const Candidates& all);
    /// Finds the loudest of them with a mean above `least`, if it is louder than `best`.
    void look_at(const Candidates& all, double least, Loudest& best);
    /// Whether one of them may have a mean above `least` that is not below `most` with the gain; of
    /// footprints that are whole.
    bool may_have(const Candidates& all, double least, double most);

    std::vector<Candidates> candidates_;  ///< work memory of peak()
    std::vector<float> counted_;          ///< bins, 0 where they do not count; whole blocks of them
    std::vector<float> top_;              ///< the greatest bin of each block
    std::vector<double> before_;          ///< the sum of all blocks before each
    std::vector<char> single_;            ///< of which blocks sum_ is made
    std::vector<double> sum_;             ///< of the bins before each
    std::size_t size_ = 0;
    double slope_ = 0, steep_ = 0, first_half_ = 0;
    double delay_ = 0;  ///< bins from the transmission to the first
    bool spreads_ = true;
};

}  // namespace echoloop::multibeam
