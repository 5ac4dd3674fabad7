// The header of a frame, as far as it is in use: 744 bytes of 1024. Data only.
#pragma once

#include <array>
#include <cstdint>

namespace echoloop::aris {

inline constexpr std::uint32_t header_version = 0x05464444;
inline constexpr std::size_t header_bytes = 744;  ///< of 1024

/// Heading, pitch and roll in deg. What a receiver's computer fills in, the sonar leaves 0.
struct FrameHeader {
    std::uint32_t index = 0;
    std::uint64_t timestamp = 0;  ///< us since 1970, the sonar's clock; the maker calls it FrameTime
    std::uint32_t version = header_version;
    std::uint32_t status = 0;
    std::uint64_t sonar_time = 0;  ///< us since 1970
    std::array<std::uint32_t, 6> reserved_28{};
    float window_start = 0, window_length = 0;  ///< m
    std::array<std::uint32_t, 2> reserved_60{};
    std::uint32_t gain = 0;                            ///< dB
    std::uint32_t temperature1 = 0, temperature2 = 0;  ///< degC
    std::uint32_t humidity = 0;
    std::uint32_t focus = 0;  ///< asked for, 0 to 1000
    std::uint32_t battery = 0;
    std::array<float, 8> user{};
    float velocity = 0, depth = 0, altitude = 0, pitch = 0, pitch_rate = 0;
    float roll = 0, roll_rate = 0, heading = 0, heading_rate = 0;
    float compass_heading = 0, compass_pitch = 0, compass_roll = 0;
    double latitude = 0, longitude = 0;
    std::array<std::uint32_t, 9> reserved_188{};
    float water_temperature = 0;  ///< degC
    std::array<std::uint32_t, 48> reserved_228{};
    float sample_rate = 0;                ///< Hz
    std::array<float, 3> acceleration{};  ///< g
    std::uint32_t ping_mode = 0, frequency = 0, pulse_width = 0, cycle_period = 0, sample_period = 0;
    std::uint32_t transmit = 0;
    float frame_rate = 0, sound_speed = 0;
    std::uint32_t samples = 0, volts_150 = 0, start_delay = 0, large_lens = 0;
    std::uint32_t system_type = 0, serial = 0;
    std::array<std::uint32_t, 4> reserved_492{};
    std::uint32_t version_build = 0, reserved_512 = 0;
    std::uint32_t reordered = 0, salinity = 0;
    float pressure = 0;  ///< psi, absolute
    std::array<std::uint32_t, 3> reserved_528{};
    std::uint32_t focus_moving = 0;
    std::array<std::uint32_t, 15> reserved_544{};
    std::uint32_t focus_position = 0;  ///< where it is, 0 to 1000
    std::array<std::uint32_t, 18> reserved_608{};
    std::uint32_t applied = 0, constrained = 0, invalid = 0;  ///< cookies
    std::uint32_t delay_enabled = 0, delay_period = 0;        ///< us
    std::uint32_t uptime = 0;                                 ///< s
    std::uint16_t version_major = 0, version_minor = 0;
    std::uint64_t go_time = 0;  ///< us
    std::array<std::uint32_t, 4> reserved_716{};
    std::uint32_t variant = 0;
    std::array<std::uint32_t, 2> reserved_736{};
    friend bool operator==(const FrameHeader&, const FrameHeader&) = default;
};

}  // namespace echoloop::aris
