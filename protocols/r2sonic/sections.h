// The sections of R2Sonic's data packets as plain structs. No wire code: layouts.h says how they stand in a
// datagram. All on the wire is big-endian. Angles are relative to the array's centre line, port negative,
// port to starboard.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "protocols/wire/text.h"

namespace echoloop::r2sonic {

/// Settings of the ping, 116 bytes.
struct H0 {
    wire::Text<12> model;            ///< e.g. "2024"
    wire::Text<12> serial;           ///< e.g. "100017"
    std::uint32_t ping_seconds = 0;  ///< s, Unix time
    std::uint32_t ping_nanoseconds = 0;
    std::uint32_t ping_number = 0;            ///< since power-up
    float ping_period = 0;                    ///< s, between the last two pings
    float sound_speed = 0;                    ///< m/s
    float frequency = 0;                      ///< Hz
    float tx_power = 0;                       ///< dB re 1 uPa at 1 m
    float tx_pulse_width = 0;                 ///< s
    float tx_beam_width_vertical = 0;         ///< rad, along track
    float tx_beam_width_horizontal = 0;       ///< rad, across track
    float tx_steering_vertical = 0;           ///< rad
    float tx_steering_horizontal = 0;         ///< rad
    std::uint16_t projector_temperature = 0;  ///< 0.01 K, 2026 only
    std::int16_t vtx_offset = 0;              ///< 0.01 dB, transmit voltage offset
    float rx_bandwidth = 0;                   ///< Hz
    float rx_sample_rate = 0;                 ///< Hz
    float rx_range = 0;                       ///< m, range setting
    float rx_gain = 0;                        ///< times 2 is dB
    float rx_spreading = 0;                   ///< dB per log10 of the range in m
    float rx_absorption = 0;                  ///< dB/km
    float rx_mount_tilt = 0;                  ///< rad
    std::uint32_t reserved108 = 0;            ///< 3 in real bathymetry, 0 in real images
    std::uint16_t reserved112 = 0;
    std::uint16_t points = 0;  ///< points (BTH0) or beams (AID0); written from the arrays' size

    friend bool operator==(const H0&, const H0&) = default;
};

/// Ranges: two-way time in s is r * scale.
struct R0 {
    float scale = 0;  ///< s; 1 / (4 * sample rate) in real data
    std::vector<std::uint16_t> r;

    friend bool operator==(const R0&, const R0&) = default;
};

/// Roll (rad), projector Z, Y, X offset (m), 0, 0.
using More = std::array<float, 6>;

/// Equi-angle beams: `points` angles from first to last.
struct A0 {
    float first = 0;  ///< rad
    float last = 0;   ///< rad
    More more{};

    friend bool operator==(const A0&, const A0&) = default;
};

/// Equi-distant beams: angle[n] = first + scale * sum(step[0..n]); step[0] is 0.
struct A2 {
    float first = 0;  ///< rad
    float scale = 0;  ///< rad
    More more{};
    std::vector<std::uint16_t> step;

    friend bool operator==(const A2&, const A2&) = default;
};

/// Beam angles of an acoustic image, any spacing.
struct A1 {
    More more{};
    std::vector<float> angle;  ///< rad

    friend bool operator==(const A1&, const A1&) = default;
};

/// Intensities: uPa is intensity * scale.
struct I1 {
    float scale = 0;  ///< uPa
    std::vector<std::uint16_t> intensity;

    friend bool operator==(const I1&, const I1&) = default;
};

/// Depth gate.
struct G0 {
    float gate_min = 0;  ///< s, two-way
    float gate_max = 0;  ///< s, two-way
    float slope = 0;     ///< rad, positive: deeper to starboard

    friend bool operator==(const G0&, const G0&) = default;
};

/// One gate of G1 in units of its scale.
struct Gate {
    std::uint8_t min = 0;
    std::uint8_t max = 0;

    friend bool operator==(const Gate&, const Gate&) = default;
};

/// "Verbose" gates, one per point: two-way s is value * scale.
struct G1 {
    float scale = 0;  ///< s
    std::vector<Gate> gate;

    friend bool operator==(const G1&, const G1&) = default;
};

/// Quality: ceil(points / 8) words of 4-bit flags, point 0 in the top nibble of the first word.
struct Q0 {
    std::vector<std::uint32_t> flags;

    friend bool operator==(const Q0&, const Q0&) = default;
};

/// Bits of one nibble of Q0.
namespace quality {
inline constexpr std::uint8_t brightness = 1;   ///< test passed (v3.0; later manuals: reserved)
inline constexpr std::uint8_t colinearity = 2;  ///< test passed (v3.0; later manuals: reserved)
inline constexpr std::uint8_t magnitude = 4;    ///< detected by magnitude
inline constexpr std::uint8_t phase = 8;        ///< detected by phase
}  // namespace quality

/// A part of an 8-bit acoustic image; data is beam-major, `beams` times `bins` bytes.
struct M0 {
    std::uint32_t ping_number = 0;  ///< equals H0's
    float reserved8 = 0;
    std::uint32_t total_samples = 0;  ///< range samples before compression, at the H0 sample rate
    std::uint32_t total_bins = 0;
    std::uint32_t first_bin = 0;
    std::uint16_t bins = 0;
    std::uint16_t total_beams = 0;  ///< multiple of 4
    std::uint16_t first_beam = 0;   ///< multiple of 4
    std::uint16_t beams = 0;        ///< multiple of 4
    std::uint32_t reserved32 = 0;
    std::vector<std::uint8_t> data;  ///< written as exactly beams * bins bytes

    friend bool operator==(const M0&, const M0&) = default;
};

}  // namespace echoloop::r2sonic
