// How late the pings of a run were: a histogram of fixed size, however long the run is. Measures nothing
// itself.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "emulator/contract/device.h"

namespace echoloop {

class Lateness {
  public:
    void add(Time late) {
        worst_ = std::max(worst_, late);
        ++count_;
        ++buckets_[bucket_of(late)];
    }
    /// Not exceeded by this part of all, 0..1; at most 5 % too high above a microsecond. 0 without any.
    Time not_exceeded_by(double part) const {
        const auto wanted = static_cast<std::uint64_t>(std::ceil(part * static_cast<double>(count_)));
        std::uint64_t seen = 0;
        for (std::size_t i = 0; i < buckets_.size(); ++i)
            if ((seen += buckets_[i]) >= wanted && wanted > 0) return std::min(worst_, end_of(i));
        return {};
    }
    Time worst() const { return worst_; }
    std::uint64_t count() const { return count_; }

  private:
    static constexpr double per_decade = 50;         // 10^(1/50): 4.7 %
    static constexpr std::size_t size = 9 * 50 + 1;  // 1 us to 1000 s

    static std::size_t bucket_of(Time late) {
        if (late <= std::chrono::microseconds(1)) return 0;
        const double place = per_decade * std::log10(static_cast<double>(late.count()) * 1e-3);
        return std::min(size - 1, static_cast<std::size_t>(std::ceil(place)));
    }
    static Time end_of(std::size_t bucket) {
        return Time(static_cast<Time::rep>(1e3 * std::pow(10, static_cast<double>(bucket) / per_decade)));
    }

    std::array<std::uint64_t, size> buckets_{};
    std::uint64_t count_ = 0;
    Time worst_{};
};

}  // namespace echoloop
