// The range bins of one rendered line while its pixels are added up. Drops what lies outside the window.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "render/fan/filled_bins.h"
#include "render/simd.h"

namespace echoloop {

/// A row of bins that it does not own, and which of them hold anything.
class LineBins {
  public:
    LineBins() = default;
    /// `length`: of the whole row, which may go on behind the bins.
    LineBins(float* values, std::size_t bins, std::size_t length)
        : values_(values),
          bins_(bins),
          shift_(FilledBins::shift_of(length)),
          last_(static_cast<float>(bins)),
          last_bin_(static_cast<int>(bins) - 1),
          begin_(bins) {}
    LineBins(float* values, std::size_t bins) : LineBins(values, bins, bins) {}

    /// Spreads `amount` over low..high, counted in bins from the leading edge of bin 0, with a density that
    /// changes by the share `slope` per bin and has its mean in the middle.
    void deposit(float low, float high, float amount, float slope = 0) {
        deposit_inline(low, high, amount, slope);
    }

    /// The same for the innermost loop, where the call would cost as much as the work.
    ECHOLOOP_INLINE void deposit_inline(float low, float high, float amount, float slope) {
        if (!(high >= 0 && low < last_)) return;  // false for NaN
        const float from = std::max(low, 0.0F), to = std::min(high, last_);
        // int: before AVX-512 no instruction turns a float into a std::size_t, or back.
        const int first = static_cast<int>(from), last = std::min(static_cast<int>(to), last_bin_);
        cover(static_cast<std::size_t>(first), static_cast<std::size_t>(last) + 1);
        const float width = high - low;
        if (first == last) {
            values_[first] += width > 0 ? amount * ((to - from) / width) : amount;
            return;
        }
        const float density = amount / width, middle = 0.5F * (low + high), change = density * slope;
        const auto piece = [&](float left, float right) {
            return (right - left) * (density + change * (0.5F * (left + right) - middle));
        };
        const auto second = static_cast<float>(first + 1);
        values_[first] += piece(from, second);
        float value = density + change * (second + 0.5F - middle);
        if (slope == 0)  // apart, so that it becomes vectors: indirect echoes are long
            for (int i = first + 1; i < last; ++i) values_[i] += density;
        else
            for (int i = first + 1; i < last; ++i) values_[i] += value, value += change;
        values_[last] += piece(static_cast<float>(last), to);
    }

    /// Adds another row's bins begin..end, times `weight`.
    void add(const float* row, float weight, std::size_t begin, std::size_t end) {
        cover(begin, end);
        for (std::size_t i = begin; i < end; ++i) values_[i] += weight * row[i];
    }

    void clear() { clear_but(0, 0); }
    /// The same, but for bins begin..end - 1, which keep what they hold: for who sets all of them.
    void clear_but(std::size_t begin, std::size_t end) {
        // Only where something is: that is half of a usual line, or less.
        for (std::uint64_t left = filled_.bits; left != 0;) {
            const int from = std::countr_zero(left), stretches = std::countr_one(left >> from);
            const std::size_t first = std::max(static_cast<std::size_t>(from) << shift_, begin_),
                              last = std::min(static_cast<std::size_t>(from + stretches) << shift_, end_);
            const std::size_t before = std::min(last, begin), behind = std::max(first, end);
            if (first < before) std::fill(values_ + first, values_ + before, 0.0F);
            if (behind < last) std::fill(values_ + behind, values_ + last, 0.0F);
            left = from + stretches < 64 ? left >> (from + stretches) << (from + stretches) : 0;
        }
        begin_ = bins_;
        end_ = 0;
        filled_ = {0};
    }
    /// For who adds to the values itself: bins begin..end - 1 may hold something.
    void cover(std::size_t begin, std::size_t end) {
        cover(begin, end, FilledBins::within(begin, end, shift_));
    }
    /// The same where it is known which of them do.
    void cover(std::size_t begin, std::size_t end, FilledBins filled) {
        begin_ = std::min(begin_, begin);
        end_ = std::max(end_, end);
        filled_ = filled_ | filled;
    }
    /// Looks which of them do.
    void look_at(std::size_t begin, std::size_t end) {
        cover(begin, end, FilledBins::find(values_, begin, end, shift_));
    }
    float* data() { return values_; }
    std::size_t size() const { return bins_; }
    bool empty() const { return begin_ >= end_; }
    const float* values() const { return values_; }
    std::size_t begin() const { return begin_; }
    std::size_t end() const { return end_; }
    /// Of the whole row, what is behind the bins left out.
    FilledBins filled() const { return filled_; }

  private:
    float* values_ = nullptr;
    std::size_t bins_ = 0;
    int shift_ = 0;  ///< of FilledBins
    float last_ = 0;
    int last_bin_ = -1;
    std::size_t begin_ = 0, end_ = 0;
    FilledBins filled_{0};
};

}  // namespace echoloop
