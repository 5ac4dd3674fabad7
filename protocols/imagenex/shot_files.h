// One shot of the maker's .81A, .852 and .31L files: a header, the reply as it came, zeros. Plain structs and
// their names only; the tables are in shot_layouts.h.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "protocols/wire/text.h"

namespace echoloop::imagenex {

inline constexpr std::size_t shot_header_bytes = 100;

/// A shot of a .852 file: 128, 384 or 640 bytes.
struct Shot852 {
    std::uint8_t index = 0;         ///< 0, 2 or 3: 0, 252 or 500 bytes of echo data
    std::uint16_t total_bytes = 0;  ///< of the shot in the file
    wire::Text<12> date;            ///< "18-Nov-2016"
    wire::Text<9> time;             ///< "19:29:10"; one real file holds reply bytes here
    wire::Text<4> hundredths;       ///< ".17"
    std::array<std::uint8_t, 5> reserved33{};
    std::uint8_t start_gain = 0;  ///< dB
    std::array<std::uint8_t, 3> reserved39{};
    std::uint8_t absorption = 20;  ///< dB/m x 100
    std::uint8_t reserved43 = 9;
    std::uint8_t pulse_length = 0;  ///< us
    std::uint8_t profile = 0;
    std::uint16_t sound_speed = 0;  ///< 0.1 m/s, bit 15: valid
    std::array<std::uint8_t, 32> reserved48{};
    std::uint16_t depth = 0;      ///< 0.1, bit 15: valid
    std::uint8_t depth_unit = 0;  ///< 'M' or 'F'
    std::uint16_t heading = 0;    ///< 0.1 deg
    std::uint16_t turns = 0;      ///< + 100
    std::uint8_t frequency = 0;   ///< 0: 675 kHz
    std::uint8_t head_id = 0x11;
    std::array<std::uint8_t, 11> reserved89{};
    std::vector<std::uint8_t> reply;  ///< as it came over the line
    std::vector<std::uint8_t> fill;   ///< zeros up to the total
    friend bool operator==(const Shot852&, const Shot852&) = default;
};

/// A shot of a .81A file: 128, 256, 384 or 640 bytes and the extended ones.
struct Shot81A {
    std::uint8_t index = 0;         ///< 0 to 3: 0, 128, 250 or 252, 500 bytes of echo data
    std::uint16_t total_bytes = 0;  ///< of the shot in the file
    wire::Text<12> date;
    wire::Text<9> time;
    wire::Text<4> hundredths;
    std::uint8_t reserved33 = 0;
    std::uint8_t extended = 0;  ///< 128 bytes
    std::array<std::uint8_t, 2> reserved35{};
    std::uint8_t scan = 0;          ///< bit 7 clockwise, 6 transducer up, 5-3 mode, 2-0 step
    std::uint8_t start_gain = 0;    ///< dB
    std::uint8_t sector_width = 0;  ///< 3 deg
    std::uint8_t train_angle = 0;   ///< 3 deg
    std::uint8_t range_offset = 0;  ///< m
    std::uint8_t absorption = 0;    ///< dB/m x 100
    std::uint8_t data_setting = 0;  ///< bit 7 profile grid, 6 zero down, 5-3 data bits, 2-0 LOGF
    std::uint8_t pulse_length = 0;  ///< 10 us
    std::uint8_t profile = 0;
    std::uint16_t sound_speed = 0;  ///< 0.1 m/s, bit 15: valid
    wire::Text<32> operator_text;
    std::uint16_t frequency = 0;  ///< kHz
    std::uint16_t azimuth = 0;    ///< bit 15: valid
    std::array<std::uint8_t, 7> reserved84{};
    std::uint16_t vertical_offset = 1800;  ///< (m + 180) x 10
    std::array<std::uint8_t, 7> reserved93{};
    std::vector<std::uint8_t> reply;
    std::vector<std::uint8_t> fill;  ///< zeros, extended bytes, and the pointer back in the last two bytes
    friend bool operator==(const Shot81A&, const Shot81A&) = default;
};

/// A shot of a .31L file: 512 bytes with a reply of 283. No specification of it is public. A public reader of
/// such files and what it printed of a real shot are the source, read as the .81A: that reader counts one
/// byte too little from the text on, so that it says 8 for the frequency's first byte of 2250 kHz.
struct Shot31L {
    static constexpr std::size_t bytes = 512, reply_bytes = 283, reply_at = 228;

    std::uint8_t index = 2;             ///< 250 bytes of echo data
    std::uint16_t total_bytes = bytes;  ///< of the shot in the file
    wire::Text<12> date;
    wire::Text<9> time;
    wire::Text<4> hundredths;  ///< ".hh", or "mmm"
    std::uint8_t reserved33 = 0;
    std::uint8_t sensors = 0;  ///< 1: pitch, roll and distance of another sensor
    std::array<std::uint8_t, 2> reserved35{};
    std::uint8_t scan = 0;          ///< bit 7 clockwise, 6 transducer up, 5-3 mode, 2-0 step
    std::uint8_t start_gain = 0;    ///< dB
    std::uint8_t sector_width = 0;  ///< 3 deg
    std::uint8_t train_angle = 0;   ///< 3 deg
    std::uint8_t range_code = 0;
    std::uint8_t absorption = 0;    ///< dB/m x 100
    std::uint8_t data_setting = 0;  ///< bit 7 profile grid, 6 zero down, 5-3 data bits, 2-0 LOGF
    std::uint8_t pulse_length = 0;  ///< us
    std::uint8_t profile = 0;
    std::uint16_t sound_speed = 0;  ///< 0.1 m/s, bit 15: valid
    wire::Text<32> operator_text;
    std::uint16_t frequency = 0;        ///< kHz
    std::uint16_t repetition_rate = 0;  ///< 0.01 Hz
    std::array<std::uint8_t, 15> reserved84{};
    std::uint8_t sensors_valid = 0;           ///< bits of the other sensor: pitch, roll, distance
    float pitch = 0, roll = 0, distance = 0;  ///< deg, deg, m of the other sensor
    std::array<std::uint8_t, 116> reserved112{};
    std::vector<std::uint8_t> reply;  ///< as it came over the line
    std::uint8_t end = 0;
    friend bool operator==(const Shot31L&, const Shot31L&) = default;
};

}  // namespace echoloop::imagenex
