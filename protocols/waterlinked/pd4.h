// The binary PD4 block of Teledyne's Doppler logs, as Water Linked's send it. Knows no state, time or device.
#pragma once

#include <array>
#include <cstdint>

#include "protocols/wire/bytes.h"
#include "protocols/wire/layout.h"
#include "protocols/wire/result.h"

namespace echoloop::waterlinked {

struct Pd4 {
    static constexpr std::int16_t bad = -32768;

    std::uint8_t configuration = 0xA3;             ///< frame, tilts, beams, frequency
    std::array<std::int16_t, 4> velocity{};        ///< mm/s, x, y, z of the report, error
    std::array<std::uint16_t, 4> range{};          ///< cm, of beams 1 to 4
    std::uint8_t status = 0;                       ///< of the bottom track
    std::array<std::int16_t, 4> water{};           ///< mm/s, against a layer of water
    std::uint16_t layer_start = 0, layer_end = 0;  ///< dm
    std::uint8_t layer_status = 0;
    std::uint8_t hour = 0, minute = 0, second = 0, hundredth = 0;
    std::uint16_t built_in_test = 0;
    std::uint16_t sound_speed = 1500;  ///< m/s
    std::int16_t temperature = 0;      ///< 0.01 degC
    std::uint16_t checksum = 0;        ///< sum of the bytes before

    friend bool operator==(const Pd4&, const Pd4&) = default;
};

constexpr auto wire_layout(wire::Tag<Pd4>) {
    using wire::field;
    return wire::make_layout<Pd4>(
        {"PD4", "velocities and ranges of a report, binary", wire::ByteOrder::little},
        wire::constant<std::uint8_t>(0x7D, "start", ""),
        wire::constant<std::uint8_t>(0, "structure", "0: PD4"),
        wire::constant<std::uint16_t>(45, "size", "bytes without the checksum"),
        field(&Pd4::configuration, "configuration", "", "frame, tilts, beams, frequency").hex(),
        field(&Pd4::velocity, "velocity", "mm/s", "x, y, z as in the report, error; -32768 is bad"),
        field(&Pd4::range, "range", "cm", "of beams 1 to 4"),
        field(&Pd4::status, "status", "", "of the bottom track; 0 is good"),
        field(&Pd4::water, "water", "mm/s", "against a layer of water"),
        field(&Pd4::layer_start, "layer_start", "dm", ""), field(&Pd4::layer_end, "layer_end", "dm", ""),
        field(&Pd4::layer_status, "layer_status", "", ""), field(&Pd4::hour, "hour", "h", ""),
        field(&Pd4::minute, "minute", "min", ""), field(&Pd4::second, "second", "s", ""),
        field(&Pd4::hundredth, "hundredth", "0.01 s", "of the first ping"),
        field(&Pd4::built_in_test, "built_in_test", "", ""),
        field(&Pd4::sound_speed, "sound_speed", "m/s", ""),
        field(&Pd4::temperature, "temperature", "0.01 degC", ""),
        field(&Pd4::checksum, "checksum", "", "sum of the bytes before").hex());
}

inline constexpr std::size_t pd4_size = 47;  ///< bytes

/// With a checksum that fits, whatever the member says.
wire::Bytes encode(Pd4 block);
/// The block that these bytes are, all of them; its checksum fits.
wire::Result<Pd4> parse_pd4(wire::ByteView bytes);
/// Sum of the bytes before the checksum.
std::uint16_t pd4_sum(wire::ByteView block);

}  // namespace echoloop::waterlinked
