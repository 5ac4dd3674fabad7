// One line of JSON that says where the vehicle is, in echoloop's own words or in those of ArduPilot's JSON
// simulator interface. A pure function of hostile text.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "emulator/pose/frames.h"
#include "render/geographic.h"
#include "render/pose.h"

namespace echoloop {

/// What one message tells; ENU and FLU.
struct PoseMessage {
    std::optional<double> time;  ///< s on the sender's clock; empty: when it arrives
    std::optional<Vec3> position;
    std::optional<Quat> attitude;     ///< world_from_body
    std::optional<Vec3> velocity{};   ///< m/s in the world; with a position only
    std::optional<Vec3> turning{};    ///< rad/s about the body's axes; with an attitude only
    std::string object{};             ///< a node of the scene; "": the vehicle
    std::optional<GeoPlace> place{};  ///< on the globe, instead of a position
    bool own_clock = false;           ///< `time` began whenever the sender liked; else it may be run time
};

struct PoseText {
    std::optional<PoseMessage> message{};
    std::string reason{};         ///< why there is no message
    std::optional<double> now{};  ///< s of run time: it asks a stepped clock to go there
};

/// Own: {"t": 1.5, "position": [x, y, z], "orientation": [w, x, y, z]}; "rpy_deg": [r, p, y] may stand for
/// the orientation, both and t may be missing; "velocity": [x, y, z] in m/s in the world and
/// "angular_velocity": [x, y, z] in rad/s about the body's axes may be there; "now": 1.5 may stand beside
/// them or alone. "latitude" and "longitude" in degrees and "altitude" or "depth" in m may stand for the
/// position; then the line tells an attitude only where it has one. ArduPilot's: {"timestamp": 1.5,
/// "position": [n, e, d], "attitude": [r, p, y]} in rad, or "quaternion": [w, x, y, z], "velocity": [n, e,
/// d], "imu": {"gyro": [r, p, y]}, NED and FRD. Other keys are passed over. Refused are numbers that are not
/// finite, positions beyond 1000 km, velocities beyond 100 m/s or rad/s, quaternions whose length is not 1
/// within 1 %.
PoseText parse_pose_line(std::string_view line);

}  // namespace echoloop
