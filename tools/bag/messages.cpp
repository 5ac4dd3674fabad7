#include "tools/bag/messages.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "tools/bag/cdr.h"

namespace echoloop::bag {
namespace {

constexpr std::uint64_t second = 1'000'000'000;

Cdr& stamp(Cdr& out, std::uint64_t time) {
    return out.number(static_cast<std::int32_t>(time / second))
        .number(static_cast<std::uint32_t>(time % second));
}

Cdr begun(const Stamped& head) {
    Cdr out;
    stamp(out, head.time).text(head.frame);
    return out;
}

void put(Cdr& out, Vec3 v) { out.number(v.x).number(v.y).number(v.z); }
void put(Cdr& out, const Quat& q) { out.number(q.x).number(q.y).number(q.z).number(q.w); }

/// From a sonar's own frame to that of its fan.
Vec3 in_fan(Vec3 v) { return {v.z, -v.y, v.x}; }

/// PingInfo; a width of 0 is not known.
void put_info(Cdr& out, double frequency, double sound_speed, double fan_height, double beam_width,
              std::size_t beams) {
    out.number(static_cast<float>(frequency)).number(static_cast<float>(sound_speed));
    for (const double width : {fan_height, beam_width})
        out.numbers(
            std::span<const float>(std::vector<float>(width > 0 ? beams : 0, static_cast<float>(width))));
}

void put_info(Cdr& out, const Echogram& echo) {
    put_info(out, echo.shot.frequency, echo.sound_speed, echo.shot.fan_height, echo.shot.beam_width,
             echo.beams());
}

void put_info(Cdr& out, const Soundings& all) {
    put_info(out, all.frequency, all.sound_speed, all.fan_height, all.beam_width, all.beams.size());
}

template <class T>
std::string samples(const Echogram& echo) {
    std::vector<T> all;
    all.reserve(echo.values.size());
    for (std::size_t bin = 0; bin < echo.shot.bins; ++bin)
        for (std::size_t beam = 0; beam < echo.beams(); ++beam)
            all.push_back(static_cast<T>(echo.values[beam * echo.shot.bins + bin]));
    return {reinterpret_cast<const char*>(all.data()), all.size() * sizeof(T)};
}

/// SonarImageData: a row for each bin, with a sample for each beam.
void put_image(Cdr& out, const Echogram& echo) {
    constexpr std::uint32_t uint8 = 0, float32 = 8;
    constexpr float most = 255;
    const bool bytes =
        std::ranges::all_of(echo.values, [](float v) { return v >= 0 && v <= most && v == std::floor(v); });
    out.flag(false)
        .number(bytes ? uint8 : float32)
        .number(static_cast<std::uint32_t>(echo.beams()))
        .bytes(bytes ? samples<std::uint8_t>(echo) : samples<float>(echo));
}

bool is_there(const Sounding& sounding) { return std::isfinite(sounding.range) && sounding.range > 0; }

void put_flags(Cdr& out, const Soundings& all) {
    constexpr std::uint8_t ok = 0, bad = 1;
    out.length(all.beams.size());
    for (const Sounding& beam : all.beams) out.number(is_there(beam) ? ok : bad);
}

template <class Number>
void put_each(Cdr& out, const Soundings& all, const Number& number) {
    out.length(all.beams.size());
    for (const Sounding& beam : all.beams) out.number(static_cast<float>(number(beam)));
}

double elevation_of(const Shot& shot, std::size_t row) {
    return shot.elevations.empty() ? 0 : shot.elevations[row];
}

}  // namespace

std::uint64_t nanoseconds(double unix_time) {
    constexpr double most = 4e9;  // s; the stamp's own end is in 2038
    if (!(unix_time > 0 && unix_time < most)) return 0;
    return static_cast<std::uint64_t>(std::llround(unix_time * 1e6)) * 1000;
}

std::string ros_name(std::string_view name) {
    std::string out;
    for (const char c : name) {
        const bool digit = c >= '0' && c <= '9', letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
        if (digit && out.empty()) out = "d";
        out += digit || letter ? c : '_';
    }
    return out.empty() ? "unnamed" : out;
}

Vec3 direction(const Shot& shot, double bearing, double elevation) {
    const Vec3 in_plane{std::cos(elevation) * std::cos(bearing), -std::cos(elevation) * std::sin(bearing),
                        std::sin(elevation)};
    return rotate(axis_angle({0, 0, 1}, -shot.pan) * axis_angle({0, 1, 0}, -shot.tilt), in_plane);
}

Soundings empty_soundings(const Echogram& echo) {
    const Shot& shot = echo.shot;
    Soundings all{shot.frequency, echo.sound_speed, shot.beam_width, shot.fan_height, {}};
    for (std::size_t row = 0; row < shot.rows(); ++row)
        for (std::size_t i = 0; i < shot.bearings.size(); ++i) {
            const double depression = i < shot.sides.size() ? shot.sides[i].depression : 0;
            const double up = (shot.elevations.empty() ? 0 : shot.elevations[row]) - depression;
            all.beams.push_back(
                {direction(shot, shot.bearings[i], up), shot.pan + shot.bearings[i], shot.tilt + up, 0, 0});
        }
    return all;
}

std::string projected_image(const Stamped& head, const Echogram& echo) {
    Cdr out = begun(head);
    put_info(out, echo);
    out.length(echo.beams());
    for (std::size_t row = 0; row < echo.shot.rows(); ++row)
        for (const double bearing : echo.shot.bearings)
            put(out, in_fan(direction(echo.shot, bearing, elevation_of(echo.shot, row))));
    out.length(echo.shot.bins);
    for (std::size_t bin = 0; bin < echo.shot.bins; ++bin)
        out.number(static_cast<float>(echo.bin_range(bin)));
    put_image(out, echo);
    return out.take();
}

std::string raw_image(const Stamped& head, const Echogram& echo) {
    const Shot& shot = echo.shot;
    Cdr out = begun(head);
    put_info(out, echo);
    const double rate = shot.bin_interval > 0 ? 1 / shot.bin_interval : 0;
    out.number(static_cast<float>(rate))
        .number(static_cast<std::uint32_t>(shot.bins))
        .number(static_cast<std::uint32_t>(std::max(0.0, std::round(shot.first_bin_time * rate))))
        .numbers(std::span<const float>(std::vector<float>(echo.beams(), 0.0F)));
    std::vector<float> up, right;
    for (std::size_t i = 0; i < shot.bearings.size(); ++i) {
        const double depression = i < shot.sides.size() ? shot.sides[i].depression : 0;
        up.push_back(static_cast<float>(shot.tilt - depression));
        right.push_back(static_cast<float>(shot.pan + shot.bearings[i]));
    }
    out.numbers(std::span<const float>(up)).numbers(std::span<const float>(right));
    put_image(out, echo);
    return out.take();
}

std::string sonar_ranges(const Stamped& head, const Soundings& all) {
    Cdr out = begun(head);
    put_info(out, all);
    put_flags(out, all);
    put_each(out, all, [](const Sounding&) { return 0; });
    put_each(out, all, [](const Sounding& beam) { return beam.intensity; });
    out.length(all.beams.size());
    for (const Sounding& beam : all.beams) put(out, in_fan(beam.direction));
    put_each(out, all, [](const Sounding& beam) { return beam.range; });
    return out.take();
}

std::string sonar_detections(const Stamped& head, const Soundings& all) {
    Cdr out = begun(head);
    put_info(out, all);
    put_flags(out, all);
    put_each(out, all,
             [&](const Sounding& beam) { return is_there(beam) ? 2 * beam.range / all.sound_speed : 0; });
    put_each(out, all, [](const Sounding&) { return 0; });
    put_each(out, all, [](const Sounding& beam) { return beam.intensity; });
    put_each(out, all, [](const Sounding& beam) { return beam.elevation; });
    put_each(out, all, [](const Sounding& beam) { return beam.bearing; });
    return out.take();
}

std::string point_cloud(const Stamped& head, const Soundings& all) {
    constexpr std::uint8_t float32 = 7;
    constexpr std::uint32_t size = sizeof(float);
    const char* const names[] = {"x", "y", "z", "intensity"};
    std::vector<float> points;
    for (const Sounding& beam : all.beams) {
        if (!is_there(beam)) continue;
        const Vec3 at = static_cast<double>(beam.range) * beam.direction;
        for (const double value : {at.x, at.y, at.z}) points.push_back(static_cast<float>(value));
        points.push_back(beam.intensity);
    }
    const auto count = static_cast<std::uint32_t>(points.size() / std::size(names)), step = 4 * size;
    Cdr out = begun(head);
    out.number(std::uint32_t{1}).number(count).length(std::size(names));
    std::uint32_t offset = 0;
    for (const char* name : names) {
        out.text(name).number(offset).number(float32).number(std::uint32_t{1});
        offset += size;
    }
    out.flag(false)
        .number(step)
        .number(step * count)
        .bytes({reinterpret_cast<const char*>(points.data()), points.size() * sizeof(float)})
        .flag(true);
    return out.take();
}

std::string picture(const Stamped& head, std::size_t width, std::size_t height, const std::string& dots) {
    Cdr out = begun(head);
    out.number(static_cast<std::uint32_t>(height))
        .number(static_cast<std::uint32_t>(width))
        .text("rgb8")
        .flag(false)
        .number(static_cast<std::uint32_t>(3 * width))
        .bytes(dots);
    return out.take();
}

std::string transforms(std::uint64_t time, const std::vector<Transform>& all) {
    Cdr out;
    out.length(all.size());
    for (const Transform& one : all) {
        stamp(out, time).text(one.parent).text(one.child);
        put(out, one.parent_from_child.position);
        put(out, one.parent_from_child.orientation);
    }
    return out.take();
}

std::string odometry(std::uint64_t time, const Pose& world_from_body, const Motion& body) {
    constexpr std::size_t covariances = 36;
    Cdr out = begun({time, "world"});
    out.text("base_link");
    put(out, world_from_body.position);
    put(out, world_from_body.orientation);
    for (std::size_t i = 0; i < covariances; ++i) out.number(0.0);
    put(out, rotate(conjugate(world_from_body.orientation), body.velocity));
    put(out, body.turning);
    for (std::size_t i = 0; i < covariances; ++i) out.number(0.0);
    return out.take();
}

std::string log_line(std::uint64_t time, Severity severity, const std::string& who, const std::string& text) {
    Cdr out;
    stamp(out, time).number(static_cast<std::uint8_t>(severity)).text(who).text(text).text("").text("");
    return out.number(std::uint32_t{0}).take();
}

std::string diagnostics(const Stamped& head, const Status& status) {
    constexpr std::uint8_t ok = 0, error = 2;
    Cdr out = begun(head);
    out.length(1)
        .number(status.error ? error : ok)
        .text(status.name)
        .text(status.message)
        .text(status.hardware);
    out.length(status.values.size());
    for (const auto& [key, value] : status.values) out.text(key).text(value);
    return out.take();
}

std::string text_message(const std::string& text) { return Cdr().text(text).take(); }

}  // namespace echoloop::bag
