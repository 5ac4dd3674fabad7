// The field tables of the MAVLink messages. Tables only.
#pragma once

#include "protocols/mavlink/messages.h"
#include "protocols/wire/layout.h"

namespace echoloop::mavlink {

using namespace wire;

constexpr Heading payload_of(std::string_view name, std::string_view help) {
    return {name, help, ByteOrder::little, 0};
}

constexpr auto wire_layout(Tag<Attitude>) {
    return make_layout<Attitude>(
        payload_of("Attitude", "30: attitude as angles"),
        field(&Attitude::time_boot_ms, "time_boot_ms", "ms", "since the vehicle's start"),
        field(&Attitude::roll, "roll", "rad", "right side down is positive"),
        field(&Attitude::pitch, "pitch", "rad", "nose up is positive"),
        field(&Attitude::yaw, "yaw", "rad", "from north to east"),
        field(&Attitude::roll_speed, "roll_speed", "rad/s", ""),
        field(&Attitude::pitch_speed, "pitch_speed", "rad/s", ""),
        field(&Attitude::yaw_speed, "yaw_speed", "rad/s", ""));
}
constexpr auto wire_layout(Tag<AttitudeQuaternion>) {
    return make_layout<AttitudeQuaternion>(
        payload_of("AttitudeQuaternion", "31: attitude as a quaternion"),
        field(&AttitudeQuaternion::time_boot_ms, "time_boot_ms", "ms", "since the vehicle's start"),
        field(&AttitudeQuaternion::q, "q", "", "w x y z, NED from FRD"),
        field(&AttitudeQuaternion::roll_speed, "roll_speed", "rad/s", ""),
        field(&AttitudeQuaternion::pitch_speed, "pitch_speed", "rad/s", ""),
        field(&AttitudeQuaternion::yaw_speed, "yaw_speed", "rad/s", ""));
}
constexpr auto wire_layout(Tag<LocalPositionNed>) {
    return make_layout<LocalPositionNed>(
        payload_of("LocalPositionNed", "32: position near the origin"),
        field(&LocalPositionNed::time_boot_ms, "time_boot_ms", "ms", "since the vehicle's start"),
        field(&LocalPositionNed::x, "x", "m", "north"), field(&LocalPositionNed::y, "y", "m", "east"),
        field(&LocalPositionNed::z, "z", "m", "down"), field(&LocalPositionNed::vx, "vx", "m/s", "north"),
        field(&LocalPositionNed::vy, "vy", "m/s", "east"), field(&LocalPositionNed::vz, "vz", "m/s", "down"));
}
constexpr auto wire_layout(Tag<GlobalPositionInt>) {
    return make_layout<GlobalPositionInt>(
        payload_of("GlobalPositionInt", "33: position on the globe"),
        field(&GlobalPositionInt::time_boot_ms, "time_boot_ms", "ms", "since the vehicle's start"),
        field(&GlobalPositionInt::latitude, "latitude", "1e-7 deg", ""),
        field(&GlobalPositionInt::longitude, "longitude", "1e-7 deg", ""),
        field(&GlobalPositionInt::altitude, "altitude", "mm", "above mean sea level"),
        field(&GlobalPositionInt::relative_altitude, "relative_altitude", "mm", "above home"),
        field(&GlobalPositionInt::vx, "vx", "cm/s", "north"),
        field(&GlobalPositionInt::vy, "vy", "cm/s", "east"),
        field(&GlobalPositionInt::vz, "vz", "cm/s", "down"),
        field(&GlobalPositionInt::heading, "heading", "0.01 deg", "65535: unknown"));
}
constexpr auto wire_layout(Tag<SimState>) {
    return make_layout<SimState>(
        payload_of("SimState", "108: the truth of a simulator"),
        field(&SimState::q, "q", "", "w x y z, NED from FRD"), field(&SimState::roll, "roll", "rad", ""),
        field(&SimState::pitch, "pitch", "rad", ""), field(&SimState::yaw, "yaw", "rad", ""),
        field(&SimState::acceleration_gyro, "acceleration_gyro", "", "m/s^2 and rad/s, x y z each"),
        field(&SimState::latitude, "latitude", "deg", ""),
        field(&SimState::longitude, "longitude", "deg", ""), field(&SimState::altitude, "altitude", "m", ""),
        field(&SimState::deviation_horizontal, "deviation_horizontal", "", ""),
        field(&SimState::deviation_vertical, "deviation_vertical", "", ""),
        field(&SimState::vn, "vn", "m/s", "north"), field(&SimState::ve, "ve", "m/s", "east"),
        field(&SimState::vd, "vd", "m/s", "down"),
        field(&SimState::exact_latitude, "exact_latitude", "1e-7 deg", "an extension of version 2"),
        field(&SimState::exact_longitude, "exact_longitude", "1e-7 deg", "both 0: not told"));
}
constexpr auto wire_layout(Tag<Odometry>) {
    return make_layout<Odometry>(
        payload_of("Odometry", "331: pose and its uncertainty"),
        field(&Odometry::time_usec, "time_usec", "us", "since 1970 or since the start"),
        field(&Odometry::x, "x", "m", "in frame_id"), field(&Odometry::y, "y", "m", "in frame_id"),
        field(&Odometry::z, "z", "m", "in frame_id"),
        field(&Odometry::q, "q", "", "w x y z, frame_id from child_frame_id"),
        field(&Odometry::vx, "vx", "m/s", ""), field(&Odometry::vy, "vy", "m/s", ""),
        field(&Odometry::vz, "vz", "m/s", ""), field(&Odometry::roll_speed, "roll_speed", "rad/s", ""),
        field(&Odometry::pitch_speed, "pitch_speed", "rad/s", ""),
        field(&Odometry::yaw_speed, "yaw_speed", "rad/s", ""),
        field(&Odometry::pose_covariance, "pose_covariance", "", "upper triangle"),
        field(&Odometry::velocity_covariance, "velocity_covariance", "", "upper triangle"),
        field(&Odometry::frame_id, "frame_id", "", "1 NED, 4 ENU, 20 FRD, 21 FLU"),
        field(&Odometry::child_frame_id, "child_frame_id", "", "12 body FRD"));
}

}  // namespace echoloop::mavlink
