// The records of the sensors around a 7k sonar as plain structs: 1003, 1012, 1013, 1016 and 7610. No wire
// code.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "protocols/wire/bytes.h"

namespace echoloop::reson7k {

struct Position {  ///< 1003
    static constexpr std::uint32_t type = 1003;
    std::uint32_t datum = 0;  ///< 0: WGS 84
    float latency = 0;        ///< s
    double latitude = 0;      ///< rad
    double longitude = 0;     ///< rad
    double height = 0;        ///< m above the ellipsoid
    std::uint8_t kind = 0;    ///< 0: geographic
    std::uint8_t zone = 0;
    std::uint8_t quality = 0;
    std::uint8_t method = 0;      ///< 15: real-time kinematic, fixed
    std::uint8_t satellites = 0;  ///< not in records of 36 bytes
    friend bool operator==(const Position&, const Position&) = default;
};

struct RollPitchHeave {  ///< 1012
    static constexpr std::uint32_t type = 1012;
    float roll = 0;   ///< rad, port up
    float pitch = 0;  ///< rad, bow up
    float heave = 0;  ///< m, up
    friend bool operator==(const RollPitchHeave&, const RollPitchHeave&) = default;
};

struct ShipHeading {  ///< 1013
    static constexpr std::uint32_t type = 1013;
    float heading = 0;  ///< rad, clockwise from north
    friend bool operator==(const ShipHeading&, const ShipHeading&) = default;
};

struct AttitudeSample {
    std::uint16_t milliseconds = 0;  ///< after the record's time
    float roll = 0, pitch = 0;       ///< rad, port up and bow up
    float heave = 0;                 ///< m, up
    float heading = 0;               ///< rad
    friend bool operator==(const AttitudeSample&, const AttitudeSample&) = default;
};
struct Attitude {  ///< 1016
    static constexpr std::uint32_t type = 1016;
    std::uint8_t count = 0;
    std::vector<AttitudeSample> samples;
    friend bool operator==(const Attitude&, const Attitude&) = default;
};

struct SoundSpeed {  ///< 7610
    static constexpr std::uint32_t type = 7610;
    float speed = 0;   ///< m/s
    wire::Bytes more;  ///< nothing, or f32 temperature in K and pressure in Pa
    friend bool operator==(const SoundSpeed&, const SoundSpeed&) = default;
};

}  // namespace echoloop::reson7k
