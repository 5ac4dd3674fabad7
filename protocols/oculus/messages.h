// The messages of Blueprint Subsea Oculus M-series sonars as plain structs, all little-endian on the wire. No
// wire code: layouts.h says how they stand there.
#pragma once

#include <array>
#include <cstdint>
#include <variant>
#include <vector>

#include "protocols/wire/bytes.h"

namespace echoloop::oculus {

enum class Id : std::uint16_t {
    status = 0,  ///< that of the datagram is not known; readers do not check it
    fire = 0x15,
    full_result = 0x22,  ///< not documented
    result = 0x23,
    user_config = 0x55,
    log_text = 0x80,
    dummy = 0xFF,
};

/// The 16 bytes before every message.
struct Header {
    std::uint16_t source = 0;       ///< the sonar's device id; 0 from a host
    std::uint16_t destination = 0;  ///< 0; one reader notes 0xFFFF in the status
    Id id = Id::status;
    std::uint16_t version = 0;       ///< v1 messages 0 or 1, v2 messages 2
    std::uint32_t payload_size = 0;  ///< bytes behind this header; 0 in fire messages of some hosts
    std::uint16_t spare = 0;         ///< 0; the maker's newer header has a part number here

    friend bool operator==(const Header&, const Header&) = default;
};

struct Frame {
    Header header;
    wire::Bytes payload;

    friend bool operator==(const Frame&, const Frame&) = default;
};

namespace flag {
inline constexpr std::uint8_t range_in_metres = 0x01;  ///< else percent
inline constexpr std::uint8_t data_16_bit = 0x02;
inline constexpr std::uint8_t gain_words = 0x04;  ///< one before each row
inline constexpr std::uint8_t simple_result = 0x08;
inline constexpr std::uint8_t gain_assist = 0x10;
inline constexpr std::uint8_t beams_512 = 0x40;      ///< else 256
inline constexpr std::uint32_t data_32_bit = 0x200;  ///< of FireV2's ext_flags
}  // namespace flag

enum class Mode : std::uint8_t { flexi = 0, low_frequency = 1, high_frequency = 2 };
/// An upper limit.
enum class Rate : std::uint8_t { hz10 = 0, hz15 = 1, hz40 = 2, hz5 = 3, hz2 = 4, standby = 5 };
enum class DataSize : std::uint8_t { bits8 = 0, bits16 = 1, bits24 = 2, bits32 = 3 };

/// What a host asks for, and what a result was made with.
struct Fire {
    Mode mode = Mode::low_frequency;
    Rate rate = Rate::hz10;
    std::uint8_t network_speed = 0;  ///< Mbit/s; 0 and 255: as fast as the link
    std::uint8_t gamma = 0;          ///< 127 is 0.5; 255 and 0 are 1
    std::uint8_t flags = 0;          ///< of namespace flag
    double range = 0;                ///< m or %
    double gain = 0;                 ///< %
    double sound_speed = 0;          ///< m/s; 0: from temperature and salinity
    double salinity = 0;             ///< ppt

    friend bool operator==(const Fire&, const Fire&) = default;
};

/// Version 2 of it.
struct FireV2 {
    Fire fire;
    std::uint32_t ext_flags = 0;
    std::array<std::uint32_t, 8> reserved{};

    friend bool operator==(const FireV2&, const FireV2&) = default;
};

/// One ping; nothing stands in `tail` that is not an image of known_image().
struct ResultV1 {
    Fire fire;
    std::uint32_t ping_id = 0;
    std::uint32_t status = 0;
    double frequency = 0;          ///< Hz
    double temperature = 0;        ///< degC; real units fill in nonsense
    double pressure = 0;           ///< bar; real units fill in nonsense
    double sound_speed = 0;        ///< m/s, the one used
    std::uint32_t start_time = 0;  ///< ns, wraps
    DataSize data_size = DataSize::bits8;
    double range_resolution = 0;  ///< m per row
    std::uint16_t ranges = 0;     ///< rows
    std::uint16_t beams = 0;      ///< columns
    std::uint32_t image_offset = 0;
    std::uint32_t image_size = 0;
    std::uint32_t message_size = 0;      ///< with the header
    std::vector<std::int16_t> bearings;  ///< 0.01 deg, ascending
    wire::Bytes tail;                    ///< a gap, then the image from image_offset on

    friend bool operator==(const ResultV1&, const ResultV1&) = default;
};

/// Version 2 of it.
struct ResultV2 {
    FireV2 fire;
    std::uint32_t ping_id = 0;
    std::uint32_t status = 0;
    double frequency = 0;                     ///< Hz
    double temperature = 0;                   ///< degC
    double pressure = 0;                      ///< bar
    double heading = 0, pitch = 0, roll = 0;  ///< deg
    double sound_speed = 0;                   ///< m/s, the one used
    double start_time = 0;                    ///< s since power-up
    DataSize data_size = DataSize::bits8;
    double range_resolution = 0;  ///< m per row
    std::uint16_t ranges = 0;     ///< rows
    std::uint16_t beams = 0;      ///< columns
    std::array<std::uint32_t, 4> spare{};
    std::uint32_t image_offset = 0;
    std::uint32_t image_size = 0;
    std::uint32_t message_size = 0;      ///< with the header
    std::vector<std::int16_t> bearings;  ///< 0.01 deg, ascending
    wire::Bytes tail;                    ///< a gap, then the image from image_offset on

    friend bool operator==(const ResultV2&, const ResultV2&) = default;
};

/// 0x22, not documented.
struct FullResult {
    wire::Bytes bytes;

    friend bool operator==(const FullResult&, const FullResult&) = default;
};

using Ipv4 = std::array<std::uint8_t, 4>;  ///< 192.168.2.4 is {192, 168, 2, 4}

struct UserConfig {
    Ipv4 ip{}, mask{};
    std::uint32_t dhcp = 0;

    friend bool operator==(const UserConfig&, const UserConfig&) = default;
};

/// ASCII.
struct LogText {
    wire::Bytes text;

    friend bool operator==(const LogText&, const LogText&) = default;
};

/// Sent in standby.
struct Dummy {
    friend bool operator==(const Dummy&, const Dummy&) = default;
};

/// major 8 bits, minor 8, build 16, from the lowest bit on.
struct Version {
    std::uint32_t version = 0, date = 0;
    friend bool operator==(const Version&, const Version&) = default;
};

/// The datagram by which a sonar is found.
struct Status {
    std::uint32_t device_id = 0;
    std::uint16_t device_type = 1;  ///< 1: imaging sonar
    std::uint16_t part_number = 0;
    std::uint32_t bits = 0;
    Version firmware0, firmware1, bit_file;
    Ipv4 ip{}, mask{}, client_ip{};  ///< client: 0.0.0.0 if none
    std::array<std::uint8_t, 6> mac{};
    std::array<double, 8> temperatures{};  ///< degC
    double pressure = 0;                   ///< bar

    friend bool operator==(const Status&, const Status&) = default;
};

using Message =
    std::variant<Fire, FireV2, ResultV1, ResultV2, FullResult, UserConfig, LogText, Dummy, Status>;

}  // namespace echoloop::oculus
