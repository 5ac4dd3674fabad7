// What a bag holds, as messages of ROS 2: each function gives one, in CDR. Frames: "world" (ENU), "base_link"
// (the vehicle, FLU), the sonar's own name (FLU), and its name with _fan: z along its axis, x up, y to
// starboard, as marine_acoustic_msgs has beams.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tools/bag/ping.h"

namespace echoloop::bag {

/// ns since 1970; 0 for what cannot be.
std::uint64_t nanoseconds(double unix_time);

/// A name as ROS takes it: letters, digits and _; the first no digit.
std::string ros_name(std::string_view name);

struct Stamped {
    std::uint64_t time = 0;  ///< ns since 1970
    std::string frame{};
};

/// A direction in a sonar's own frame, of length 1. Angles in rad, as Shot has them.
Vec3 direction(const Shot& shot, double bearing, double elevation);

/// Of a fan or one beam, not of rows. Levels in uPa^2, or what the device counts: then 8 bits where these do.
std::string projected_image(const Stamped& head, const Echogram& echogram);
/// Of single beams that are not beside each other: the same levels, with the angles of each.
std::string raw_image(const Stamped& head, const Echogram& echogram);

/// A beam and what is in it.
struct Sounding {
    Vec3 direction{};
    double bearing = 0, elevation = 0;  ///< rad
    float range = 0;                    ///< m; NaN or 0: nothing
    float intensity = 0;
};
struct Soundings {
    double frequency = 0, sound_speed = 0, beam_width = 0, fan_height = 0;  ///< 0: not known
    std::vector<Sounding> beams{};
};
/// The beams of an echogram, with nothing in them yet.
Soundings empty_soundings(const Echogram& echogram);
std::string sonar_ranges(const Stamped& head, const Soundings& soundings);
std::string sonar_detections(const Stamped& head, const Soundings& soundings);
/// Of the soundings that there are: x, y, z in m and intensity.
std::string point_cloud(const Stamped& head, const Soundings& soundings);

/// Red, green, blue.
std::string picture(const Stamped& head, std::size_t width, std::size_t height, const std::string& dots);

struct Transform {
    std::string parent{}, child{};
    Pose parent_from_child{};
};
std::string transforms(std::uint64_t time, const std::vector<Transform>& all);
/// Of base_link in the world; velocities are told in base_link.
std::string odometry(std::uint64_t time, const Pose& world_from_body, const Motion& body);

enum class Severity : std::uint8_t { info = 20, warning = 30, error = 40 };
std::string log_line(std::uint64_t time, Severity severity, const std::string& who, const std::string& text);

struct Status {
    bool error = false;
    std::string name{}, message{}, hardware{};
    std::vector<std::pair<std::string, std::string>> values{};
};
std::string diagnostics(const Stamped& head, const Status& status);

std::string text_message(const std::string& text);

}  // namespace echoloop::bag
