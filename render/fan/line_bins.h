// The range bins of one rendered line while its pixels are added up. Drops what lies outside the window.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace echoloop {

class LineBins {
  public:
    explicit LineBins(std::size_t bins) : values_(bins), last_(static_cast<float>(bins)) {}

    /// Spreads `amount` evenly over low..high, counted in bins from the leading edge of bin 0.
    void deposit(float low, float high, float amount) {
        if (!(high >= 0 && low < last_)) return;  // false for NaN
        const float from = std::max(low, 0.0F), to = std::min(high, last_);
        const auto first = static_cast<std::size_t>(from);
        const std::size_t last = std::min(static_cast<std::size_t>(to), values_.size() - 1);
        begin_ = std::min(begin_, first);
        end_ = std::max(end_, last + 1);
        const float width = high - low;
        if (first == last) {
            values_[first] += width > 0 ? amount * ((to - from) / width) : amount;
            return;
        }
        const float density = amount / width;
        values_[first] += density * (static_cast<float>(first + 1) - from);
        for (std::size_t i = first + 1; i < last; ++i) values_[i] += density;
        values_[last] += density * (to - static_cast<float>(last));
    }

    /// Adds the bins that hold anything, times `weight`, to a beam's.
    void add_to(float* beam, float weight) const {
        for (std::size_t i = begin_; i < end_; ++i) beam[i] += weight * values_[i];
    }

    void clear() {
        for (std::size_t i = begin_; i < end_; ++i) values_[i] = 0;
        begin_ = values_.size();
        end_ = 0;
    }

  private:
    std::vector<float> values_;
    float last_;
    std::size_t begin_ = values_.size(), end_ = 0;
};

}  // namespace echoloop
