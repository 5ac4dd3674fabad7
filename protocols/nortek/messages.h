// Data of Nortek's Doppler logs, Nucleus and DVL, as plain structs. No wire code: layouts.h says how they
// stand on the line. Offsets and units are those of the maker's public driver and of public readers of DF21.
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

/// Bottom track of a DVL (the maker's data format 21), and water track (22).
struct DvlTrack {
    std::uint8_t version = 1, offset = 36;
    std::uint32_t serial_number = 0;
    std::uint8_t year = 0, month = 0, day = 0;  ///< since 1900; 0 is January; from 1 on
    std::uint8_t hour = 0, minute = 0, second = 0;
    std::uint16_t fraction = 0;  ///< 100 us, of the second
    std::uint16_t beams = 4;
    std::uint32_t error = 0, status = 0;
    float sound_speed = 0, temperature = 0, pressure = 0;                           ///< m/s, degC, bar
    std::array<float, 4> beam_velocity{}, distance{}, beam_merit{};                 ///< m/s, m, m/s
    std::array<float, 4> beam_from_trigger{}, beam_from_output{}, beam_duration{};  ///< s
    std::array<float, 4> velocity{}, merit{};                                       ///< m/s: x, y, z1, z2
    std::array<float, 4> from_trigger{}, from_output{}, duration{};                 ///< s

    friend bool operator==(const DvlTrack&, const DvlTrack&) = default;
};

/// What has no table here.
struct Other {
    std::vector<std::uint8_t> values;
    friend bool operator==(const Other&, const Other&) = default;
};

struct Frame {
    std::uint8_t id = 0, family = 0x20;
    std::variant<Track, Altimeter, Ahrs, Imu, DvlTrack, Other> data;
    friend bool operator==(const Frame&, const Frame&) = default;
};

inline constexpr std::uint8_t nucleus_family = 0x20, bottom_track_id = 0xB4, water_track_id = 0xBE,
                              altimeter_id = 0xAA, ahrs_id = 0xD2, imu_id = 0x82;
inline constexpr std::uint8_t dvl_family = 0x10, dvl_bottom_track_id = 0x1B, dvl_water_track_id = 0x1D;

}  // namespace echoloop::nortek
