// Numbers distinct keys in the order in which they come. An open hash table: quick for millions of small
// keys.
#pragma once

#include <cstdint>
#include <vector>

namespace echoloop {

/// `Key` has == and a member hash().
template <typename Key>
class Numbering {
  public:
    explicit Numbering(std::size_t expected = 64) { resize(expected); }

    /// The key's number, and a new one if it was not there.
    std::uint32_t operator()(const Key& key) {
        if (2 * (keys_.size() + 1) > slots_.size()) resize(2 * keys_.size());
        std::uint32_t& slot = slot_of(key);
        if (slot == empty) {
            slot = static_cast<std::uint32_t>(keys_.size());
            keys_.push_back(key);
        }
        return slot;
    }
    const std::vector<Key>& keys() const { return keys_; }

  private:
    static constexpr std::uint32_t empty = ~0U;

    std::uint32_t& slot_of(const Key& key) {
        const std::size_t mask = slots_.size() - 1;
        std::size_t at = key.hash() & mask;
        while (slots_[at] != empty && !(keys_[slots_[at]] == key)) at = (at + 1) & mask;
        return slots_[at];
    }
    void resize(std::size_t expected) {
        std::size_t size = 64;
        while (size < 2 * expected + 2) size *= 2;
        slots_.assign(size, empty);
        for (std::uint32_t i = 0; i < keys_.size(); ++i) slot_of(keys_[i]) = i;
    }

    std::vector<Key> keys_;
    std::vector<std::uint32_t> slots_;
};

/// Mixes the bits of a key's three parts.
inline std::size_t mix(std::uint64_t a, std::uint64_t b, std::uint64_t c) {
    std::uint64_t h =
        a * 0x9E3779B97F4A7C15U ^ (b + 0x7F4A7C15U) * 0xC2B2AE3D27D4EB4FU ^ (c + 1) * 0x165667B19E3779F9U;
    h ^= h >> 29U;
    h *= 0xBF58476D1CE4E5B9U;
    return h ^ (h >> 32U);
}

}  // namespace echoloop
