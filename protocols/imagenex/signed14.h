// Fourteen signed bits and two flags in two bytes, as the inclinometer of an 831L says them. Numbers only.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace echoloop::imagenex {

/// Both bytes as they came: the low one is whole, the high one has six bits of the number below two flags.
struct Signed14 {
    std::uint8_t low = 0;
    std::uint8_t high = 0;

    static constexpr int least = -8192, most = 8191;
    static constexpr std::uint8_t is_new = 0x80, alarm = 0x40;  ///< flags

    constexpr Signed14() = default;
    constexpr explicit Signed14(int value, std::uint8_t flags = 0)
        : low(static_cast<std::uint8_t>(static_cast<unsigned>(value))),
          high(static_cast<std::uint8_t>((static_cast<unsigned>(value) >> 8 & 0x3F) | flags)) {}
    constexpr int value() const {
        const int bits = (high & 0x3F) << 8 | low;
        return bits > most ? bits - 0x4000 : bits;
    }
    friend constexpr bool operator==(const Signed14&, const Signed14&) = default;
};

/// `value` in steps of `step`, cut at the ends of the scale.
inline Signed14 signed14(double value, double step, std::uint8_t flags) {
    return Signed14(
        static_cast<int>(std::lround(std::clamp<double>(value / step, Signed14::least, Signed14::most))),
        flags);
}

}  // namespace echoloop::imagenex
