#include "tools/poses/common/line.h"

#include <array>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>

#include "emulator/pose/limits.h"

namespace echoloop::poses {
namespace {

/// The shortest text that means this number.
std::string number(double value) {
    std::array<char, 32> text;
    const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
    return {text.data(), end};
}

std::string list(std::initializer_list<double> values) {
    std::string text;
    for (const double value : values) text += (text.empty() ? "[" : ", ") + number(value);
    return text + "]";
}

bool finite(const Pose& p) {
    const auto& [w, x, y, z] = p.orientation;
    for (const double value : {p.position.x, p.position.y, p.position.z, w, x, y, z})
        if (!std::isfinite(value)) return false;
    return true;
}

/// The line up to where it says the place.
std::string beginning(const std::string& object, const std::string& key, std::optional<Nanoseconds> time) {
    std::string line = "{";
    if (time) line += '"' + key + "\": " + seconds_text(*time) + ", ";
    if (!object.empty())
        line += "\"object\": " +
                nlohmann::json(object).dump(-1, ' ', true, nlohmann::json::error_handler_t::replace) + ", ";
    return line;
}

}  // namespace

std::string seconds_text(Nanoseconds time) {
    constexpr Nanoseconds second = 1'000'000'000;
    const Nanoseconds whole = time < 0 ? -time : time;
    auto fraction = std::to_string(whole % second + second).substr(1);
    fraction.erase(fraction.find_last_not_of('0') + 1);
    return (time < 0 ? "-" : "") + std::to_string(whole / second) + (fraction.empty() ? "" : "." + fraction);
}

std::string pose_line(const Pose& pose, const std::string& object, const std::string& key,
                      std::optional<Nanoseconds> time, const Rates& rates) {
    std::string line = beginning(object, key, time);
    const auto& [w, x, y, z] = pose.orientation;
    line += "\"position\": " + list({pose.position.x, pose.position.y, pose.position.z});
    line += ", \"orientation\": " + list({w, x, y, z});
    const auto add = [&line](const char* name, const std::optional<Vec3>& rate) {
        if (rate && norm(*rate) < swiftest)  // false for numbers that are none
            line += std::string(", \"") + name + "\": " + list({rate->x, rate->y, rate->z});
    };
    add("velocity", rates.velocity), add("angular_velocity", rates.turning);
    return line + "}";
}

std::string fix_line(const std::array<double, 3>& fix, const std::string& object, const std::string& key,
                     std::optional<Nanoseconds> time) {
    return beginning(object, key, time) + "\"latitude\": " + number(fix[0]) +
           ", \"longitude\": " + number(fix[1]) + ", \"altitude\": " + number(fix[2]) + "}";
}

std::string step_line(Nanoseconds now) { return "{\"now\": " + seconds_text(now) + "}"; }

std::string fault_of_fix(const std::array<double, 3>& fix) {
    const auto& [latitude, longitude, altitude] = fix;
    if (std::isnan(altitude)) return "it tells no altitude, which a vehicle under water needs";
    if (!std::isfinite(latitude + longitude + altitude)) return "a number is not finite";
    if (std::abs(latitude) > 90 || std::abs(longitude) > 360) return "its place is none on the Earth";
    return {};
}

std::string fault_of(const Pose& pose) {
    constexpr double tolerance = 0.01;
    if (!finite(pose)) return "a number is not finite";
    if (norm(pose.position) > farthest) return "the position is more than 1000 km from the origin";
    const auto& [w, x, y, z] = pose.orientation;
    const double length = std::sqrt(w * w + x * x + y * y + z * z);
    if (length == 0) return "the orientation is all zero: its publisher has not filled it in";
    if (std::abs(length - 1) > tolerance) return "the quaternion's length is not 1";
    return {};
}

}  // namespace echoloop::poses
