#include "emulator/pose/mavlink_pose.h"

#include <cmath>
#include <limits>

#include "emulator/pose/limits.h"

namespace echoloop {
namespace {

enum Rank { angles = 1, quaternion, rounded, global, local, simulator, odometry };

constexpr Time patience = std::chrono::seconds(3);

double seconds(std::uint32_t boot_ms) { return boot_ms * 1e-3; }

Quat to_quat(const std::array<float, 4>& q) { return {q[0], q[1], q[2], q[3]}; }

Quat enu_attitude(Quat ned_from_frd) { return enu_from_ned({{}, ned_from_frd}).orientation; }

/// Empty where a number of it is none, which is how a sender says that it does not know.
std::optional<Vec3> known(Vec3 rate) {
    return std::isnan(rate.x + rate.y + rate.z) ? std::nullopt : std::optional(rate);
}

/// rad/s of any message, about the axes of the body.
template <class M>
std::optional<Vec3> turning_of(const M& m) {
    return known(flu_from_frd({m.roll_speed, m.pitch_speed, m.yaw_speed}));
}

/// Makes the attitude a unit quaternion. Written so that numbers that are none are found as well.
std::string fault_of(PoseMessage& message) {
    if (message.time && !(*message.time <= longest)) return "a time that cannot be";
    if (message.position && !(norm(*message.position) < farthest)) return "a position that cannot be";
    for (const auto* rate : {&message.velocity, &message.turning})
        if (*rate && !(norm(**rate) < swiftest)) return "a velocity that cannot be";
    if (!message.attitude) return {};
    Quat& q = *message.attitude;
    const double length = std::sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
    if (!(std::abs(length - 1) < 0.01)) return "an attitude that cannot be";
    q = {q.w / length, q.x / length, q.y / length, q.z / length};
    return {};
}

struct Rates {
    Vec3 velocity, turning;  ///< in the frame, about the body's axes; not numbers where nothing is told
};

/// They are told in the child's frame: the body's axes, or the frame itself.
Rates rates_of(const mavlink::Odometry& m, Quat frame_from_body) {
    namespace frames = mavlink::frames;
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    const Vec3 velocity{m.vx, m.vy, m.vz}, turning{m.roll_speed, m.pitch_speed, m.yaw_speed};
    for (const auto body : {frames::body_ned, frames::body_frd, frames::body_flu})
        if (m.child_frame_id == body) return {rotate(frame_from_body, velocity), turning};
    if (m.child_frame_id == m.frame_id) return {velocity, rotate(conjugate(frame_from_body), turning)};
    return {{none, none, none}, {none, none, none}};
}

/// Of an odometry that is told in no frame of the world.
std::string fault_of_frame(const mavlink::Message& message) {
    namespace frames = mavlink::frames;
    const auto* const m = std::get_if<mavlink::Odometry>(&message);
    if (m == nullptr) return {};
    for (const auto known : {frames::local_ned, frames::local_enu, frames::local_frd, frames::local_flu})
        if (m->frame_id == known) return {};
    return "ODOMETRY in frame " + std::to_string(m->frame_id) +
           "; frames of the world are MAV_FRAME_LOCAL_NED, _ENU, _FRD and _FLU: 1, 4, 20 and 21";
}

}  // namespace

/// An autopilot that starts anew, or a filter that gives up, leaves others to tell what it told.
void MavlinkPose::forget_the_silent(Time now) {
    const bool no_position = now - position_heard_ > patience, no_attitude = now - attitude_heard_ > patience;
    if (no_position) position_rank_ = 0;
    if (no_attitude) attitude_rank_ = 0;
    if (no_position && no_attitude) system_.reset();
}

PoseText MavlinkPose::add(const mavlink::Message& message, std::uint8_t system, Time heard) {
    forget_the_silent(heard);
    if (system_ && *system_ != system)
        return {{},
                "system " + std::to_string(system) + " tells poses as well; the vehicle is system " +
                    std::to_string(*system_) + ", which was the first to"};
    if (std::string fault = fault_of_frame(message); !fault.empty()) return {{}, std::move(fault)};
    place_is_rounded_ = false;
    PoseMessage told = std::visit([this](const auto& m) { return read(m); }, message);
    const int rank_of_place = place_is_rounded_ ? Rank::rounded : rank_;
    if (rank_of_place < position_rank_) told.position.reset(), told.velocity.reset();
    if (rank_ < attitude_rank_) told.attitude.reset(), told.turning.reset();
    if (!told.position && !told.attitude) return {};
    if (const auto fault = fault_of(told); !fault.empty()) return {{}, fault};
    if (told.position) {
        position_rank_ = rank_of_place;
        position_heard_ = heard;
    }
    if (told.attitude) {
        attitude_rank_ = rank_;
        attitude_heard_ = heard;
    }
    system_ = system;
    return {told, ""};
}

/// Not finite for a place that is none on the globe.
Vec3 MavlinkPose::in_world(const GeoPlace& place) {
    if (origin_) return enu_from_place(*origin_, place);
    if (!(std::abs(place.latitude) <= 90) || !(std::abs(place.longitude) <= 360))
        return enu_from_place({}, place);
    const GeoPlace here{place.latitude, place.longitude, 0};
    if (!first_) first_ = here;
    const Vec3 moved = enu_from_place(*first_, place);
    const bool no_fix_yet =
        first_->latitude == 0 && first_->longitude == 0;  // what autopilots say until then
    if (!no_fix_yet || norm(moved) < farthest) return moved;
    first_ = here;
    return enu_from_place(*first_, place);
}

PoseMessage MavlinkPose::read(const mavlink::Attitude& m) {
    rank_ = angles;
    return {seconds(m.time_boot_ms), {}, enu_attitude(from_rpy(m.roll, m.pitch, m.yaw)), {}, turning_of(m)};
}

PoseMessage MavlinkPose::read(const mavlink::AttitudeQuaternion& m) {
    rank_ = quaternion;
    return {seconds(m.time_boot_ms), {}, enu_attitude(to_quat(m.q)), {}, turning_of(m)};
}

PoseMessage MavlinkPose::read(const mavlink::LocalPositionNed& m) {
    rank_ = local;
    return {seconds(m.time_boot_ms),
            enu_from_ned(Vec3{m.x, m.y, m.z}),
            {},
            known(enu_from_ned(Vec3{m.vx, m.vy, m.vz}))};
}

PoseMessage MavlinkPose::read(const mavlink::GlobalPositionInt& m) {
    rank_ = global;
    if (position_rank_ > global) return {};  // or its place would be the first
    return {seconds(m.time_boot_ms),
            in_world({m.latitude * 1e-7, m.longitude * 1e-7, m.altitude * 1e-3}),
            {},
            enu_from_ned(Vec3{m.vx * 1e-2, m.vy * 1e-2, m.vz * 1e-2})};
}

/// It tells no time. In single precision degrees are rounded to a metre or more.
PoseMessage MavlinkPose::read(const mavlink::SimState& m) {
    rank_ = simulator;
    if (!std::isfinite(m.latitude) || !std::isfinite(m.longitude)) return {};
    place_is_rounded_ = m.exact_latitude == 0 && m.exact_longitude == 0;
    PoseMessage told{{}, {}, enu_attitude(to_quat(m.q)), known(enu_from_ned(Vec3{m.vn, m.ve, m.vd}))};
    told.turning =
        known(flu_from_frd({m.acceleration_gyro[3], m.acceleration_gyro[4], m.acceleration_gyro[5]}));
    if (!place_is_rounded_)
        told.position = in_world({m.exact_latitude * 1e-7, m.exact_longitude * 1e-7, m.altitude});
    else if (position_rank_ <= rounded)
        told.position = in_world({m.latitude, m.longitude, m.altitude});
    return told;
}

PoseMessage MavlinkPose::read(const mavlink::Odometry& m) {
    namespace frames = mavlink::frames;
    rank_ = odometry;
    const double time = static_cast<double>(m.time_usec) * 1e-6;
    const Pose pose{{m.x, m.y, m.z}, to_quat(m.q)};
    const auto [velocity, turning] = rates_of(m, pose.orientation);
    if (m.frame_id == frames::local_enu || m.frame_id == frames::local_flu)  // these have the body up as well
        return {time, pose.position, pose.orientation, known(velocity), known(turning)};
    const Pose up = enu_from_ned(pose);
    return {time, up.position, up.orientation, known(enu_from_ned(velocity)), known(flu_from_frd(turning))};
}

}  // namespace echoloop
