// The counts met so far in one message, by key. Small, on the stack, never allocates.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <string_view>

#include "protocols/wire/field.h"

namespace echoloop::wire {

class Counts {
  public:
    static constexpr std::uint64_t unknown = std::numeric_limits<std::uint64_t>::max();

    std::uint64_t get(std::string_view key) const {
        for (std::size_t i = 0; i < size_; ++i) {
            if (slots_[i].key == key) return slots_[i].value;
        }
        return unknown;
    }
    /// False if the key already has another value, or if a table has more keys than there are slots.
    bool set(std::string_view key, std::uint64_t value) {
        const std::uint64_t old = get(key);
        if (old != unknown) return old == value;
        if (size_ == slots_.size()) return false;
        slots_[size_++] = {key, value};
        return true;
    }
    /// Elements that `ref` asks for; all counts are at most 32 bits wide, so a product fits.
    std::uint64_t elements(const CountRef& ref) const {
        const std::uint64_t first = get(ref.key);
        const std::uint64_t second = ref.times.empty() ? 1 : get(ref.times);
        if (first == unknown || second == unknown) return unknown;
        return (first * second + ref.per - 1) / ref.per;
    }

  private:
    struct Slot {
        std::string_view key;
        std::uint64_t value = 0;
    };
    std::array<Slot, 8> slots_{};
    std::size_t size_ = 0;
};

}  // namespace echoloop::wire
