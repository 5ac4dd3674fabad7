#include "emulator/devices/family/survey/motion_unit.h"

namespace echoloop::survey {

Axes axes_of(Quat world_from_device) {
    const Axes upright = axes_of_vehicle(world_from_device);
    const bool looks_down = std::hypot(upright.down.x, upright.down.y) >= 0.5;
    return looks_down ? Axes{-1 * upright.down, upright.starboard, upright.ahead} : upright;
}

Axes axes_of_vehicle(Quat world_from_body) {
    return {rotate(world_from_body, {1, 0, 0}), rotate(world_from_body, {0, -1, 0}),
            rotate(world_from_body, {0, 0, -1})};
}

double Heave::at(double height, Time now) {
    constexpr double memory = 10;  // s
    const double usual = usual_.value_or(height);
    usual_ = std::lerp(height, usual, std::exp(-to_seconds(now - last_) / memory));
    last_ = now;
    return *usual_ - height;
}

Reading MotionUnit::read(const Located& where) {
    const Pose& pose = where.world_from_device;
    const Axes axes = mount_ == Mount::head ? axes_of(pose.orientation) : axes_of_vehicle(pose.orientation);
    const auto read = [&](const char* name, double truth, const Stray& stray) {
        return sensors_.read(name, truth, stray, where.time);
    };
    Reading r;
    r.time = where.time;
    r.place = place_from_enu(origin_, {read("east", pose.position.x, strays_.position),
                                       read("north", pose.position.y, strays_.position),
                                       read("height", pose.position.z, strays_.position)});
    const double roll = std::atan2(-axes.starboard.z, -axes.down.z);
    const double pitch = std::atan2(axes.ahead.z, std::hypot(axes.ahead.x, axes.ahead.y));
    r.roll = read("roll", rad_to_deg(roll), strays_.motion);
    r.pitch = read("pitch", rad_to_deg(pitch), strays_.motion);
    r.heading =
        sensors_.read_bearing("compass", turned_once(rad_to_deg(std::atan2(axes.ahead.x, axes.ahead.y))),
                              strays_.heading, where.time);
    r.heave = read("heave", heave_.at(pose.position.z, where.time), strays_.position);

    const Vec3 turning = rotate(pose.orientation, where.motion.turning);
    const double p = dot(turning, axes.ahead), q = dot(turning, axes.starboard),
                 yaw = dot(turning, axes.down);
    const double about_vertical = q * std::sin(roll) + yaw * std::cos(roll);
    r.roll_rate = rad_to_deg(p + about_vertical * std::tan(pitch));
    r.pitch_rate = rad_to_deg(q * std::cos(roll) - yaw * std::sin(roll));
    r.yaw_rate = rad_to_deg(about_vertical / std::cos(pitch));

    const Vec3 velocity = where.motion.velocity;
    r.north = read("velocity north", velocity.y, strays_.velocity);
    r.east = read("velocity east", velocity.x, strays_.velocity);
    r.down = read("velocity down", -velocity.z, strays_.velocity);
    r.speed = std::hypot(r.north, r.east);
    r.course = turned_once(rad_to_deg(std::atan2(r.east, r.north)));
    return r;
}

}  // namespace echoloop::survey
