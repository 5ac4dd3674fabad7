// The MAVLink messages that say where a vehicle is, and the frame around them. Fields are in wire order (by
// size, as MAVLink sorts them), little endian; extensions of version 2 are left out. Source: the "common"
// message definitions.
#pragma once

#include <array>
#include <cstdint>
#include <variant>
#include <vector>

namespace echoloop::mavlink {

/// Message ids.
enum class Id : std::uint32_t {
    attitude = 30,
    attitude_quaternion = 31,
    local_position_ned = 32,
    global_position_int = 33,
    sim_state = 108,
    odometry = 331,
};

/// Angles in rad, forward-right-down against north-east-down.
struct Attitude {
    std::uint32_t time_boot_ms = 0;
    float roll = 0, pitch = 0, yaw = 0;                    ///< rad
    float roll_speed = 0, pitch_speed = 0, yaw_speed = 0;  ///< rad/s
};

struct AttitudeQuaternion {
    std::uint32_t time_boot_ms = 0;
    std::array<float, 4> q{1, 0, 0, 0};                    ///< w x y z, NED from FRD
    float roll_speed = 0, pitch_speed = 0, yaw_speed = 0;  ///< rad/s
};

struct LocalPositionNed {
    std::uint32_t time_boot_ms = 0;
    float x = 0, y = 0, z = 0;     ///< m, north east down
    float vx = 0, vy = 0, vz = 0;  ///< m/s
};

struct GlobalPositionInt {
    std::uint32_t time_boot_ms = 0;
    std::int32_t latitude = 0, longitude = 0;          ///< 1e-7 deg
    std::int32_t altitude = 0, relative_altitude = 0;  ///< mm above mean sea level, above home
    std::int16_t vx = 0, vy = 0, vz = 0;               ///< cm/s
    std::uint16_t heading = 0;                         ///< 0.01 deg
};

struct SimState {
    std::array<float, 4> q{1, 0, 0, 0};        ///< w x y z, NED from FRD
    float roll = 0, pitch = 0, yaw = 0;        ///< rad
    std::array<float, 6> acceleration_gyro{};  ///< m/s^2, rad/s
    float latitude = 0, longitude = 0;         ///< deg
    float altitude = 0;                        ///< m
    float deviation_horizontal = 0, deviation_vertical = 0;
    float vn = 0, ve = 0, vd = 0;                          ///< m/s
    std::int32_t exact_latitude = 0, exact_longitude = 0;  ///< 1e-7 deg; both 0: not told (version 1)
};

struct Odometry {
    std::uint64_t time_usec = 0;
    float x = 0, y = 0, z = 0;           ///< m, in frame_id
    std::array<float, 4> q{1, 0, 0, 0};  ///< w x y z, frame_id from child_frame_id
    float vx = 0, vy = 0, vz = 0;
    float roll_speed = 0, pitch_speed = 0, yaw_speed = 0;
    std::array<float, 21> pose_covariance{}, velocity_covariance{};
    std::uint8_t frame_id = 0, child_frame_id = 0;  ///< MAV_FRAME
};

/// MAV_FRAME of Odometry.
namespace frames {
inline constexpr std::uint8_t local_ned = 1, local_enu = 4, body_ned = 8, body_frd = 12, body_flu = 13,
                              local_frd = 20, local_flu = 21;
}

using Message =
    std::variant<Attitude, AttitudeQuaternion, LocalPositionNed, GlobalPositionInt, SimState, Odometry>;

/// One frame of either version; its checksum is right if the message is one of the above, and was not looked
/// at otherwise.
struct Frame {
    std::uint8_t version = 2;
    std::uint8_t sequence = 0, system = 0, component = 0;
    std::uint32_t id = 0;
    std::vector<std::uint8_t> payload;  ///< version 2: without the zeros at its end
};

}  // namespace echoloop::mavlink
