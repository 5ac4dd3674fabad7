// Numbers to bytes and back, in both byte orders, one at a time or a whole array. Never looks beyond the
// bytes given.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>
#include <vector>

namespace echoloop::wire {

using Bytes = std::vector<std::uint8_t>;
using ByteView = std::span<const std::uint8_t>;

enum class ByteOrder { little, big };

/// Integers, floats and enums: what one wire number holds.
template <class T>
concept Scalar = (std::is_arithmetic_v<T> && !std::is_same_v<T, bool>) || std::is_enum_v<T>;

template <ByteOrder Order>
inline constexpr bool is_native = (Order == ByteOrder::little) ==
                                  (std::endian::native == std::endian::little);

/// The unsigned integer of `Size` bytes.
template <std::size_t Size>
using Unsigned =
    std::conditional_t<Size == 1, std::uint8_t,
                       std::conditional_t<Size == 2, std::uint16_t,
                                          std::conditional_t<Size == 4, std::uint32_t, std::uint64_t>>>;

constexpr std::uint8_t swap_bytes(std::uint8_t v) { return v; }
constexpr std::uint16_t swap_bytes(std::uint16_t v) { return __builtin_bswap16(v); }
constexpr std::uint32_t swap_bytes(std::uint32_t v) { return __builtin_bswap32(v); }
constexpr std::uint64_t swap_bytes(std::uint64_t v) { return __builtin_bswap64(v); }

template <ByteOrder Order, Scalar T>
T load(const std::uint8_t* from) {
    Unsigned<sizeof(T)> raw;
    std::memcpy(&raw, from, sizeof raw);
    if constexpr (!is_native<Order>) raw = swap_bytes(raw);
    return std::bit_cast<T>(raw);
}

template <ByteOrder Order, Scalar T>
void store(T value, std::uint8_t* to) {
    auto raw = std::bit_cast<Unsigned<sizeof(T)>>(value);
    if constexpr (!is_native<Order>) raw = swap_bytes(raw);
    std::memcpy(to, &raw, sizeof raw);
}

/// Reads `to.size()` numbers from `from`, which holds at least that many.
template <ByteOrder Order, Scalar T>
void load_array(const std::uint8_t* from, std::span<T> to) {
    if (to.empty()) return;
    if constexpr (sizeof(T) == 1 || is_native<Order>) {
        std::memcpy(to.data(), from, to.size_bytes());
    } else {
        for (std::size_t i = 0; i < to.size(); ++i) to[i] = load<Order, T>(from + i * sizeof(T));
    }
}

/// Writes all of `from` to `to`, which has room for it.
template <ByteOrder Order, Scalar T>
void store_array(std::span<const T> from, std::uint8_t* to) {
    if (from.empty()) return;
    if constexpr (sizeof(T) == 1 || is_native<Order>) {
        std::memcpy(to, from.data(), from.size_bytes());
    } else {
        for (std::size_t i = 0; i < from.size(); ++i) store<Order, T>(from[i], to + i * sizeof(T));
    }
}

}  // namespace echoloop::wire
