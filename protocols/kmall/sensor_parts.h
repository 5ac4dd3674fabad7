// What the datagrams of sensors are made of, #SPO to #SSM, #CHE and #FCF, as plain structs. No wire code: the
// layouts say how they stand on the wire.
#pragma once

#include <array>
#include <cstdint>

#include "protocols/wire/text.h"

namespace echoloop::kmall {

/// Which sensor speaks, and whether it is to be believed.
struct SensorInfo {
    std::uint16_t size = 8;
    std::uint16_t system = 0;
    std::uint16_t status = 0;
    std::uint16_t padding = 0;
    friend bool operator==(const SensorInfo&, const SensorInfo&) = default;
};

/// #SPO, #CPO.
struct Position {
    std::uint32_t seconds = 0, nanoseconds = 0;
    float fix_quality = 0;
    double latitude = 0, longitude = 0;
    float speed = 0, course = 0, height = 0;
    friend bool operator==(const Position&, const Position&) = default;
};
/// #SPE.
struct PositionError {
    std::uint32_t seconds = 0, nanoseconds = 0;
    float rms = 0, major_axis = 0, minor_axis = 0, orientation = 0;
    float latitude = 0, longitude = 0, height = 0;
    friend bool operator==(const PositionError&, const PositionError&) = default;
};
/// #SPD.
struct Datum {
    wire::Text<16> name, subname;
    double latitude_offset = 0, longitude_offset = 0;
    float altitude_offset = 0;
    wire::Text<32> reference;
    friend bool operator==(const Datum&, const Datum&) = default;
};
/// #SCL.
struct Clock {
    float offset = 0;
    std::int32_t deviation = 0;
    friend bool operator==(const Clock&, const Clock&) = default;
};
/// #SDE of version 0.
struct DepthSensor0 {
    float depth = 0, offset = 0, scale = 0;
    double latitude = 0, longitude = 0;
    friend bool operator==(const DepthSensor0&, const DepthSensor0&) = default;
};
/// #SDE from version 1 on.
struct DepthSensor {
    float depth = 0, raw_depth = 0, offset = 0, scale = 0;
    double latitude = 0, longitude = 0;
    friend bool operator==(const DepthSensor&, const DepthSensor&) = default;
};
/// #SHI.
struct Height {
    std::uint16_t sensor_type = 0;
    float height = 0;
    friend bool operator==(const Height&, const Height&) = default;
};
/// #SSM.
struct SoundSpeedManager {
    float sound_speed = 0, transducer_depth = 0;
    std::uint32_t unknown0 = 0;
    float mean_depth = 0;
    std::uint32_t unknown1 = 0;
    double latitude = 0, longitude = 0;
    friend bool operator==(const SoundSpeedManager&, const SoundSpeedManager&) = default;
};

/// #SHA: begins it; samples follow.
struct HeadingsInfo {
    std::uint16_t size = 8;
    std::uint16_t samples = 0;
    std::uint16_t bytes_per_sample = 0;
    std::uint16_t text_bytes = 0;
    friend bool operator==(const HeadingsInfo&, const HeadingsInfo&) = default;
};
struct HeadingSample {
    std::uint32_t nanoseconds = 0;
    float heading = 0;
    friend bool operator==(const HeadingSample&, const HeadingSample&) = default;
};

/// #SVT: begins it; samples follow.
struct SoundSpeedInfo {
    std::uint16_t size = 20;
    std::uint16_t status = 0;
    std::uint16_t format = 0;
    std::uint16_t samples = 0;
    std::uint16_t bytes_per_sample = 0;
    std::uint16_t contents = 0;
    float filter = 0, offset = 0;
    friend bool operator==(const SoundSpeedInfo&, const SoundSpeedInfo&) = default;
};
struct SoundSpeedSample {
    std::uint32_t seconds = 0, nanoseconds = 0;
    float sound_speed = 0, temperature = 0, pressure = 0, salinity = 0;
    friend bool operator==(const SoundSpeedSample&, const SoundSpeedSample&) = default;
};

/// #SKM: begins it; samples follow.
struct MotionInfo {
    std::uint16_t size = 12;
    std::uint8_t system = 0;
    std::uint8_t status = 0;
    std::uint16_t format = 0;
    std::uint16_t samples = 0;
    std::uint16_t bytes_per_sample = 0;
    std::uint16_t contents = 0;
    friend bool operator==(const MotionInfo&, const MotionInfo&) = default;
};
struct MotionSample {
    wire::Text<4> mark;
    std::uint16_t size = 0, version = 0;
    std::uint32_t seconds = 0, nanoseconds = 0, status = 0;
    double latitude = 0, longitude = 0;
    float height = 0;
    float roll = 0, pitch = 0, heading = 0, heave = 0;
    float roll_rate = 0, pitch_rate = 0, yaw_rate = 0;
    float velocity_north = 0, velocity_east = 0, velocity_down = 0;
    std::array<float, 7> errors{};
    float acceleration_north = 0, acceleration_east = 0, acceleration_down = 0;
    std::uint32_t delayed_seconds = 0, delayed_nanoseconds = 0;
    float delayed_heave = 0;
    friend bool operator==(const MotionSample&, const MotionSample&) = default;
};

/// #CHE: heave of a ping, behind its body.
struct Heave {
    float heave = 0;
    friend bool operator==(const Heave&, const Heave&) = default;
};

/// #FCF: begins it; the file, or a part of it, follows.
struct FileInfo {
    std::uint16_t size = 72;
    std::int8_t status = 0;
    std::uint8_t padding = 0;
    std::uint32_t file_bytes = 0;
    wire::Text<64> name;
    friend bool operator==(const FileInfo&, const FileInfo&) = default;
};

}  // namespace echoloop::kmall
