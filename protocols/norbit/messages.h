// The packets of a Norbit WBMS as plain structs, all little-endian on the wire. No wire code: layouts.h says
// how they stand there.
#pragma once

#include <array>
#include <cstdint>
#include <variant>
#include <vector>

#include "protocols/wire/bytes.h"

namespace echoloop::norbit {

enum class Type : std::uint32_t { bathymetry = 1, water_column = 2, snippet = 4, side_scan = 5 };
enum class BeamMode : std::uint8_t { ea512 = 1, ea256, ed256, ea512x, ea256x };
enum class SonarMode : std::uint8_t {
    forward_looking = 0,
    bathymetry = 1,
    amplitude = 2,
    pass_through = 4,
    edge = 5,
    super_resolution = 6,
};
enum class Sample : std::uint32_t { u8, s8, u16, s16, u32, s32, u64, s64, f32 = 0x15, f64 = 0x17 };

/// The 24 bytes before every packet, its first four left out.
struct Header {
    Type type = Type::bathymetry;
    std::uint32_t size = 0;  ///< of the packet, with this header
    std::uint32_t version = 4;
    std::uint32_t reserved = 0;
    std::uint32_t crc = 0;  ///< CRC-32 of the bytes behind the header; reserved in snippets and side scan

    friend bool operator==(const Header&, const Header&) = default;
};

struct Frame {
    Header header;
    wire::Bytes payload;

    friend bool operator==(const Frame&, const Frame&) = default;
};

inline constexpr std::uint8_t snr_good = 1, colinear = 2;       ///< bits of a point's quality
inline constexpr std::uint16_t by_magnitude = 1, by_phase = 2;  ///< bits of a point's flags

/// One sounding. Range = sample x sound speed / (2 x sample rate).
struct Point {
    std::uint32_t sample = 0;
    float angle = 0;               ///< rad from nadir
    std::uint16_t upper_gate = 0;  ///< samples
    std::uint16_t lower_gate = 0;  ///< samples
    float intensity = 0;
    std::uint16_t flags = 0;
    std::uint8_t quality = 0;
    std::uint8_t snr = 0;  ///< sqrt(16 x signal / noise), of amplitudes

    friend bool operator==(const Point&, const Point&) = default;
};

struct Bathymetry {
    float sound_speed = 0;  ///< m/s
    float sample_rate = 0;  ///< Hz
    std::uint32_t ping = 0;
    double transmit_time = 0;  ///< s
    double send_time = 0;      ///< s
    float ping_rate = 0;       ///< Hz
    std::uint16_t data_type = 4;
    BeamMode beam_mode = BeamMode::ea256;
    SonarMode sonar_mode = SonarMode::bathymetry;
    float time_uncertainty = 0;
    std::uint16_t multi_pings = 0;
    std::uint16_t multi_ping = 0;
    float tx_angle = 0;  ///< rad
    float intensity_gain = 0;
    float frequency = 0;  ///< Hz
    float bandwidth = 0;  ///< Hz
    float pulse = 0;      ///< s
    float raw_sound_speed = 0;
    float tx_voltage = 0;
    float swath_direction = 0;  ///< rad
    float swath_opening = 0;    ///< rad
    float gate_tilt = 0;        ///< rad
    std::vector<Point> points;

    friend bool operator==(const Bathymetry&, const Bathymetry&) = default;
};

/// Water column and forward-looking images; snippets and side scan have the same head.
struct WaterColumn {
    float sound_speed = 0;      ///< m/s
    float sample_rate = 0;      ///< Hz
    std::uint32_t beams = 0;    ///< columns
    std::uint32_t samples = 0;  ///< rows
    double transmit_time = 0;   ///< s
    Sample sample = Sample::s16;
    std::int32_t t0 = 0;  ///< sample of the first row
    float gain = 0;       ///< dB
    std::uint32_t spare1 = 0;
    float swath_direction = 0;  ///< rad
    float swath_opening = 0;    ///< rad
    float frequency = 0;
    float bandwidth = 0;
    float pulse = 0;              ///< s
    std::uint32_t amplitude = 0;  ///< 0 to 15
    std::array<std::uint8_t, 12> spare2{};
    float ping_rate = 0;  ///< Hz
    std::uint32_t spare3 = 0;
    std::uint32_t ping = 0;
    double send_time = 0;  ///< s
    std::uint32_t beamformer_beams = 0;
    std::int32_t t1 = 0;
    std::uint32_t g1 = 0;  ///< dB, the bits of an f32 or s32
    std::int32_t t2 = 0;
    std::uint32_t g2 = 0;
    std::uint32_t spare4 = 0;
    float tx_angle = 0;  ///< rad
    float tx_voltage = 0;
    BeamMode beam_mode = BeamMode::ea256;
    SonarMode sonar_mode = SonarMode::bathymetry;
    std::uint16_t spare5 = 0;
    float gate_tilt = 0;  ///< rad
    std::array<std::uint8_t, 32> spare6{};
    wire::Bytes tail;  ///< rows of all beams, nearest first, then one f32 angle a beam

    friend bool operator==(const WaterColumn&, const WaterColumn&) = default;
};

using Message = std::variant<Bathymetry, WaterColumn>;

}  // namespace echoloop::norbit
