// The words of an 837 Delta T's program on UDP: 83P to the host, EC from it. Plain structs that know no
// bytes.
#pragma once

#include <array>
#include <cstdint>
#include <variant>
#include <vector>

#include "protocols/wire/bytes.h"
#include "protocols/wire/layout.h"
#include "protocols/wire/text.h"

namespace echoloop::imagenex {

using wire::ByteOrder;
using wire::Tag;

namespace delta_t {
inline constexpr std::uint16_t valid = 0x8000;     ///< with an attitude or sound speed
inline constexpr std::uint8_t roll_corrected = 1;  ///< of Profile83P::flags
inline constexpr std::uint8_t has_heading = 1, has_roll = 2, has_pitch = 4;  ///< of Profile83P::sensors
}  // namespace delta_t

/// One ping as profile points: a .83P file is a row of these. Ranges hold at 1500 m/s whatever the sound
/// speed.
struct Profile83P {
    std::uint8_t version = 10;  ///< 0: v1.00, whose bytes from 100 on are zero; 10: v1.10
    std::uint16_t reserved6 = 0;
    wire::Text<12> date;       ///< DD-MMM-YYYY
    wire::Text<9> time;        ///< HH:MM:SS
    wire::Text<4> hundredths;  ///< .hh
    wire::Text<14> latitude, longitude;
    std::uint8_t speed = 0;                  ///< 0.1 kn
    std::uint16_t course = 0;                ///< 0.1 deg
    std::uint16_t pitch = 0, roll = 0;       ///< 0.1 deg + 900, bit 15 valid
    std::uint16_t heading = 0;               ///< 0.1 deg, bit 15 valid
    std::uint16_t samples = 0;               ///< of a beam
    std::uint16_t sector = 0;                ///< deg
    std::uint16_t start_angle = 0;           ///< 0.01 deg + 18000
    std::uint8_t angle_increment = 0;        ///< 0.01 deg
    std::uint16_t range = 0, frequency = 0;  ///< m, kHz
    std::uint16_t sound_speed = 0;           ///< 0.1 m/s, bit 15 valid
    std::uint16_t resolution = 0;            ///< mm, unit of the ranges
    std::uint16_t reserved87 = 0;
    std::uint16_t tilt = 180;         ///< deg + 180
    std::uint16_t ping_interval = 0;  ///< ms
    std::uint32_t ping_number = 0;
    std::array<std::uint8_t, 3> reserved97{};
    float x_offset = 0, y_offset = 0, z_offset = 0;    ///< m
    wire::Text<5> milliseconds;                        ///< .mmm
    std::uint8_t has_intensity = 0;                    ///< 0 or 1
    std::uint16_t ping_latency = 0, data_latency = 0;  ///< 100 us
    std::uint8_t sample_rate = 0;                      ///< ranges to 1 in 500 (0) or 1 in 5000 (1)
    std::uint8_t flags = 0;                            ///< bits of namespace delta_t
    std::uint8_t reserved124 = 0;
    std::uint8_t pings_averaged = 0;
    std::uint16_t centre_ping_offset = 0;  ///< 100 us
    float heave = 0;                       ///< m
    std::uint8_t user = 0;
    float altitude = 0;        ///< m
    std::uint8_t sensors = 0;  ///< external ones; bits of namespace delta_t
    float external_pitch = 0, external_roll = 0, external_heading = 0;  ///< deg
    std::uint8_t transmit_scan = 0;
    float scan_angle = 0;  ///< deg
    std::array<std::uint8_t, 101> reserved155{};
    std::vector<std::uint16_t> ranges;       ///< one a beam, port first; 0: none
    std::vector<std::uint16_t> intensities;  ///< as many or none
    friend bool operator==(const Profile83P&, const Profile83P&) = default;
};

/// "EC", what a host sets from outside. Numbers are codes of the specification unless they have a unit.
struct ExternalControl {
    std::uint8_t id = 0;
    std::uint8_t external = 1;      ///< 0: the program's own settings
    std::uint8_t receive_only = 0;  ///< 1: no pulse is sent
    std::uint16_t reserved5 = 0;
    std::uint8_t range = 0;  ///< 2 to 14: 5 to 300 m
    std::uint8_t gain = 0;   ///< dB, 0 to 20
    std::uint8_t display_gain = 0, gain_equalisation = 0;
    std::uint8_t sector = 0;      ///< 0 to 3: 30, 60, 90, 120 deg
    std::uint8_t beam_width = 0;  ///< 0 wide, 1 normal, 2 narrow, 3 narrow mixed
    std::uint8_t beams = 0;       ///< 0, 1, 2: 480, 240, 120
    std::uint8_t averaging = 0;   ///< pings; 0 and 1: off
    std::uint16_t persistence = 0;
    std::uint16_t sound_speed = 0;  ///< 0.1 m/s; some hosts send it little-endian
    std::uint8_t mode = 0;
    std::uint8_t output = 0;  ///< 0, 1, 2: 83P, 83B, 83F
    std::uint8_t profile = 0;
    std::uint8_t minimum_range = 0;  ///< m
    std::uint8_t minimum_level = 0;  ///< %
    std::uint8_t transducer_up = 0;
    std::uint8_t tilt = 180;  ///< deg + 180
    std::uint8_t roll_compensation = 0, reserved27 = 0;
    std::uint8_t record_837 = 0, record_83p = 0, reserved30 = 0;
    std::uint8_t control = 0;
    std::uint16_t trigger_delay = 0;
    std::uint8_t profile_filter = 0;
    std::array<std::uint8_t, 221> reserved35{};
    friend bool operator==(const ExternalControl&, const ExternalControl&) = default;
};

using DeltaTMessage = std::variant<Profile83P, ExternalControl>;

}  // namespace echoloop::imagenex
