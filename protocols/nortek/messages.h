// Data of Nortek's Nucleus as plain structs. No wire code: layouts.h says how they stand on the line. Offsets
// and units are those of the maker's public driver.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "protocols/wire/bytes.h"

namespace echoloop::nortek {

inline constexpr float no_velocity = -32.768F, no_merit = 10;  ///< m/s; a distance that there is not is 0

/// Bottom track and water track.
struct Track {
    std::uint8_t version = 1, offset = 36;
    std::uint16_t flags = 1;
    std::uint32_t seconds = 0, microseconds = 0, status = 0, serial_number = 0, error = 0;
    float sound_speed = 0, temperature = 0, pressure = 0;            ///< m/s, degC, bar
    std::array<float, 3> beam_velocity{}, distance{}, beam_merit{};  ///< m/s, m, m/s
    std::array<float, 3> beam_delay{}, beam_duration{};              ///< s
    std::array<float, 3> velocity{}, merit{};                        ///< m/s
    float delay = 0, duration = 0;                                   ///< s

    friend bool operator==(const Track&, const Track&) = default;
};

struct Altimeter {
    std::uint8_t version = 1, offset = 36;
    std::uint16_t flags = 1;
    std::uint32_t seconds = 0, microseconds = 0, status = 0, serial_number = 0, error = 0;
    float sound_speed = 0, temperature = 0, pressure = 0;
    float distance = 0;  ///< m
    std::uint16_t quality = 0;

    friend bool operator==(const Altimeter&, const Altimeter&) = default;
};

struct Ahrs {
    std::uint8_t version = 2, offset = 36;
    std::uint16_t flags = 1;
    std::uint32_t seconds = 0, microseconds = 0, status = 0, serial_number = 0, error = 0;
    std::uint8_t mode = 2;
    std::array<std::uint8_t, 3> spare{};
    float merit = 0, calibration_merit = 0;
    float roll = 0, pitch = 0, heading = 0;  ///< deg
    std::array<float, 4> quaternion{1, 0, 0, 0};
    std::array<float, 9> matrix{};
    float declination = 0, depth = 0;  ///< deg, m

    friend bool operator==(const Ahrs&, const Ahrs&) = default;
};

struct Imu {
    std::uint8_t version = 1, offset = 16;
    std::uint16_t flags = 1;
    std::uint32_t seconds = 0, microseconds = 0, status = 1;
    std::array<float, 3> acceleration{}, rotation{};  ///< m/s^2, rad/s
    float temperature = 0;                            ///< degC

    friend bool operator==(const Imu&, const Imu&) = default;
};

/// What has no table here.
struct Other {
    std::vector<std::uint8_t> values;
    friend bool operator==(const Other&, const Other&) = default;
};

struct Frame {
    std::uint8_t id = 0, family = 0x20;
    std::variant<Track, Altimeter, Ahrs, Imu, Other> data;
    friend bool operator==(const Frame&, const Frame&) = default;
};

inline constexpr std::uint8_t nucleus_family = 0x20, bottom_track_id = 0xB4, water_track_id = 0xBE,
                              altimeter_id = 0xAA, ahrs_id = 0xD2, imu_id = 0x82;

}  // namespace echoloop::nortek
