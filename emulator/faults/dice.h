// Chance for faults, as a function of its key alone: the time of day and the order of questions change
// nothing. Holds no state.
#pragma once

#include "emulator/contract/random_key.h"

namespace echoloop {

/// Independent numbers for each fault, message and place.
class Dice {
  public:
    explicit constexpr Dice(std::uint64_t key) : key_(key) {}

    /// Those of one thing among others: a port, a message, a byte.
    constexpr Dice of(std::uint64_t thing) const { return Dice(split_mix(key_ ^ split_mix(thing))); }
    /// 0 <= x < 1.
    constexpr double uniform(std::uint64_t place = 0) const {
        return static_cast<double>(word(place) >> 11) * 0x1p-53;
    }
    /// 0 <= x < limit, for limits far below 2^64.
    constexpr std::uint64_t below(std::uint64_t limit, std::uint64_t place = 0) const {
        return limit == 0 ? 0 : word(place) % limit;
    }
    constexpr std::uint64_t word(std::uint64_t place = 0) const { return split_mix(key_ + split_mix(place)); }

  private:
    std::uint64_t key_;
};

}  // namespace echoloop
