// The sections of R2Sonic's status packets as plain structs. No wire code. In a packet they stand in any
// order.
#pragma once

#include <array>
#include <cstdint>
#include <variant>
#include <vector>

#include "protocols/wire/text.h"

namespace echoloop::r2sonic {

struct Ser3 {
    wire::Text<12> serial;
    friend bool operator==(const Ser3&, const Ser3&) = default;
};
struct Prt3 {
    wire::Text<12> part;
    friend bool operator==(const Prt3&, const Prt3&) = default;
};
struct Mdl3 {
    wire::Text<12> model;
    friend bool operator==(const Mdl3&, const Mdl3&) = default;
};
/// Firmware of the controller, e.g. "19-Dec-2011-17:19:29".
struct Fwv6 {
    wire::Text<24> firmware;
    friend bool operator==(const Fwv6&, const Fwv6&) = default;
};
/// Firmware of the transmitter, head only.
struct Fwt6 {
    wire::Text<24> firmware;
    friend bool operator==(const Fwt6&, const Fwt6&) = default;
};
/// Projector, head only.
struct Prj9 {
    wire::Text<12> serial;
    wire::Text<12> part;
    wire::Text<12> model;
    friend bool operator==(const Prj9&, const Prj9&) = default;
};
/// Bits of namespace option_bits, head only.
struct Opt1 {
    std::uint32_t options = 0;
    friend bool operator==(const Opt1&, const Opt1&) = default;
};
/// Sensors of the head, "SENa" on the wire.
struct SenA {
    std::uint32_t gps_seconds = 0;
    std::uint32_t gps_fraction = 0;  ///< s / 2^32
    float pitch = 0;                 ///< rad
    float roll = 0;                  ///< rad
    float heave = 0;                 ///< m
    float heading = 0;               ///< not implemented by the device
    float sound_speed = 0;           ///< m/s
    float depth_uncalibrated = 0;
    float depth = 0;             ///< m, calibrated
    float fpga_temperature = 0;  ///< C
    friend bool operator==(const SenA&, const SenA&) = default;
};
/// Sensors of the SIM.
struct Sen7 {
    std::uint32_t gps_seconds = 0;
    std::uint32_t gps_fraction = 0;  ///< s / 2^32
    float pitch = 0;                 ///< rad
    float roll = 0;                  ///< rad
    float heave = 0;                 ///< m
    float reserved = 0;
    float sound_speed = 0;  ///< m/s
    friend bool operator==(const Sen7&, const Sen7&) = default;
};
/// Supply of the head.
struct Adc3 {
    float supply_voltage = 0;       ///< V, nominal 48
    float supply_current = 0;       ///< A
    float transmitter_voltage = 0;  ///< V
    friend bool operator==(const Adc3&, const Adc3&) = default;
};
/// Supply of the SIM.
struct Adc2 {
    float supply_voltage = 0;  ///< V, nominal 48
    float supply_current = 0;  ///< A
    friend bool operator==(const Adc2&, const Adc2&) = default;
};
/// Ethernet.
struct Eth6 {
    std::uint32_t link = 0;  ///< Mbit/s
    std::uint32_t rx_packets = 0;
    std::uint32_t tx_packets = 0;
    std::uint32_t rx_overflows = 0;
    std::array<std::uint8_t, 8> mac{};  ///< the last 6 are used
    friend bool operator==(const Eth6&, const Eth6&) = default;
};
struct Tim2 {
    float round_trip = 0;  ///< s between head and SIM, below 3 ms
    float spare = 0;
    friend bool operator==(const Tim2&, const Tim2&) = default;
};
/// Lamps of the SIM: 2-bit fields (0 off, 1 undefined, 2 bad, 3 good) from bit 0: gps, motion, heading, svp,
/// 4 alternates, pps, sync in, sync out, head on.
struct Led1 {
    std::uint32_t lamps = 0;
    friend bool operator==(const Led1&, const Led1&) = default;
};
/// A section that is not in this list; its word count is the 4th character as a base-36 digit.
struct UnknownStatus {
    wire::Text<4> name;
    std::vector<std::uint32_t> words;
    friend bool operator==(const UnknownStatus&, const UnknownStatus&) = default;
};

/// Bits of Opt1::options.
namespace option_bits {
inline constexpr std::uint32_t truepix_snippets = 0x01;
inline constexpr std::uint32_t depth_3km = 0x02;  ///< else 100 m
inline constexpr std::uint32_t forward_looking = 0x04;
inline constexpr std::uint32_t water_column = 0x08;
inline constexpr std::uint32_t ultra_high_resolution = 0x10;
inline constexpr std::uint32_t water_column_rx_channels = 0x20;
inline constexpr std::uint32_t bottom_fill = 0x40;
}  // namespace option_bits

using StatusSection = std::variant<Ser3, Prt3, Mdl3, Fwv6, Fwt6, Prj9, Opt1, SenA, Sen7, Adc3, Adc2, Eth6,
                                   Tim2, Led1, UnknownStatus>;

}  // namespace echoloop::r2sonic
