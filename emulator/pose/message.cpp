#include "emulator/pose/message.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "emulator/pose/limits.h"

namespace echoloop {
namespace {

using Json = nlohmann::json;

/// Thrown inside this file only.
struct Refusal {
    std::string reason;
};

double number(const Json& value, const char* key) {
    if (!value.is_number() || !std::isfinite(value.get<double>()))
        throw Refusal{std::string(key) + ": expected a finite number"};
    return value.get<double>();
}

template <std::size_t n>
std::array<double, n> numbers(const Json& object, const char* key) {
    const Json& list = object.at(key);
    if (!list.is_array() || list.size() != n)
        throw Refusal{std::string(key) + ": expected a list of " + std::to_string(n) + " numbers"};
    std::array<double, n> values;
    for (std::size_t i = 0; i < n; ++i) values[i] = number(list[i], key);
    return values;
}

Vec3 position(const Json& object) {
    const auto [x, y, z] = numbers<3>(object, "position");
    if (norm({x, y, z}) > farthest) throw Refusal{"position: more than 1000 km from the origin"};
    return {x, y, z};
}

/// In m/s or rad/s, if it is there.
std::optional<Vec3> rate(const Json& object, const char* key) {
    if (!object.contains(key)) return {};
    const auto [x, y, z] = numbers<3>(object, key);
    if (norm({x, y, z}) > swiftest) throw Refusal{std::string(key) + ": more than 100 m/s or rad/s"};
    return Vec3{x, y, z};
}

/// Of a fix: the altitude of a NavSatFix, or a depth below the same level.
GeoPlace place(const Json& object) {
    for (const char* const key : {"latitude", "longitude"})
        if (!object.contains(key)) throw Refusal{std::string(key) + " is missing"};
    if (object.contains("position")) throw Refusal{"position and latitude: give one of them"};
    if (object.contains("altitude") == object.contains("depth"))
        throw Refusal{"latitude: \"altitude\" or \"depth\" in m belongs to it, one of them"};
    const double latitude = number(object.at("latitude"), "latitude");
    const double longitude = number(object.at("longitude"), "longitude");
    if (std::abs(latitude) > 90) throw Refusal{"latitude: not within 90 degrees"};
    if (std::abs(longitude) > 360) throw Refusal{"longitude: not within 360 degrees"};
    const bool has_depth = object.contains("depth");
    return {latitude, longitude,
            has_depth ? -number(object.at("depth"), "depth") : number(object.at("altitude"), "altitude")};
}

bool tells_place(const Json& object) { return object.contains("latitude") || object.contains("longitude"); }

Quat read_quaternion(const Json& object, const char* key) {
    constexpr double tolerance = 0.01;
    const auto [w, x, y, z] = numbers<4>(object, key);
    const double length = std::sqrt(w * w + x * x + y * y + z * z);
    if (std::abs(length - 1) > tolerance)
        throw Refusal{std::string(key) + ": the quaternion's length is not 1"};
    return {w / length, x / length, y / length, z / length};
}

std::optional<double> time(const Json& object, const char* key) {
    if (!object.contains(key)) return {};
    const double t = number(object.at(key), key);
    if (std::abs(t) > longest) throw Refusal{std::string(key) + ": no time in seconds"};
    return t;
}

/// The name of the thing that is meant, "" for the vehicle.
std::string subject(const Json& object) {
    if (!object.contains("object")) return {};
    const Json& name = object.at("object");
    if (!name.is_string() || name.get_ref<const std::string&>().empty())
        throw Refusal{"object: expected the name of a node"};
    return name;
}

PoseMessage of_ardupilot(const Json& object) {
    Pose ned_from_frd{position(object), {}};
    if (object.contains("quaternion")) {
        ned_from_frd.orientation = read_quaternion(object, "quaternion");
    } else {
        const auto [roll, pitch, yaw] = numbers<3>(object, "attitude");
        ned_from_frd.orientation = from_rpy(roll, pitch, yaw);
    }
    const Pose pose = enu_from_ned(ned_from_frd);
    PoseMessage message{time(object, "timestamp"), pose.position, pose.orientation};
    if (const auto v = rate(object, "velocity")) message.velocity = enu_from_ned(*v);
    if (object.contains("imu") && object.at("imu").is_object())
        if (const auto w = rate(object.at("imu"), "gyro")) message.turning = flu_from_frd(*w);
    message.object = subject(object), message.own_clock = true;
    return message;
}

PoseMessage of_echoloop(const Json& object) {
    PoseMessage message{time(object, "t"), {}, {}};
    if (tells_place(object))
        message.place = place(object);
    else
        message.position = position(object), message.attitude = Quat{};
    message.object = subject(object);
    message.velocity = rate(object, "velocity"), message.turning = rate(object, "angular_velocity");
    if (object.contains("orientation")) message.attitude = read_quaternion(object, "orientation");
    if (object.contains("rpy_deg")) {
        if (object.contains("orientation")) throw Refusal{"orientation and rpy_deg: give one of them"};
        const auto [roll, pitch, yaw] = numbers<3>(object, "rpy_deg");
        message.attitude = from_rpy(deg_to_rad(roll), deg_to_rad(pitch), deg_to_rad(yaw));
    }
    return message;
}

/// Or a part of one, which is a mistake.
bool tells_pose(const Json& object) {
    constexpr std::array keys{"position",   "orientation", "rpy_deg",  "attitude",
                              "quaternion", "latitude",    "longitude"};
    return std::ranges::any_of(keys, [&object](const char* key) { return object.contains(key); });
}

}  // namespace

PoseText parse_pose_line(std::string_view line) {
    const Json object = Json::parse(line, nullptr, false);
    if (object.is_discarded()) return {{}, "no JSON", {}};
    if (!object.is_object()) return {{}, "expected a JSON object in braces", {}};
    try {
        const auto now = time(object, "now");
        if (now && !tells_pose(object)) return {{}, "", now};
        if (!object.contains("position") && !tells_place(object))
            return {{}, "\"position\": [x, y, z] is missing", {}};
        const bool ardupilot =
            !tells_place(object) && (object.contains("attitude") || object.contains("quaternion"));
        return {ardupilot ? of_ardupilot(object) : of_echoloop(object), "", now};
    } catch (const Refusal& refusal) {
        return {{}, refusal.reason, {}};
    }
}

}  // namespace echoloop
