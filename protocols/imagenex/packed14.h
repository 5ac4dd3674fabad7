// Fourteen bits in two bytes whose bit 7 stays free for the control bytes of the line. Numbers only.
#pragma once

#include <cstdint>
#include <limits>

namespace echoloop::imagenex {

/// Both bytes as they came; the number is (high & 7F) << 7 | (low & 7F).
struct Packed14 {
    std::uint8_t low = 0;
    std::uint8_t high = 0;

    constexpr Packed14() = default;
    /// Bits beyond the fourteenth are cut.
    constexpr explicit Packed14(std::uint64_t value)
        : low(static_cast<std::uint8_t>(value & 0x7F)), high(static_cast<std::uint8_t>(value >> 7 & 0x7F)) {}
    constexpr operator std::uint64_t() const {
        return static_cast<std::uint64_t>(high & 0x7F) << 7 | (low & 0x7F);
    }
    friend constexpr bool operator==(const Packed14&, const Packed14&) = default;
};

}  // namespace echoloop::imagenex

/// So that a table can count with it.
template <>
class std::numeric_limits<echoloop::imagenex::Packed14> {
  public:
    static constexpr bool is_specialized = true;
    static constexpr echoloop::imagenex::Packed14 max() { return echoloop::imagenex::Packed14(0x3FFF); }
};
