#include <charconv>
#include <cmath>
#include <cstdio>

#include "emulator/devices/waterlinked-dvl/report.h"

namespace echoloop::waterlinked_dvl {
namespace {

/// Members of an object in order.
class Object {
  public:
    Object& raw(std::string_view key, std::string_view value) {
        text_ += text_.empty() ? "{" : ",";
        text_.append(1, '"').append(key).append("\":").append(value);
        return *this;
    }
    Object& number(std::string_view key, double value, int decimals) {
        return raw(key, number_text(value, decimals));
    }
    Object& whole(std::string_view key, std::int64_t value) { return raw(key, std::to_string(value)); }
    Object& flag(std::string_view key, bool value) { return raw(key, value ? "true" : "false"); }
    Object& word(std::string_view key, std::string_view value) {
        return raw(key, '"' + std::string(value) + '"');
    }
    std::string text() const { return text_ + '}'; }

  private:
    std::string text_;
};

std::string list(const std::vector<std::string>& items) {
    std::string text = "[";
    for (const std::string& item : items) {
        if (text.size() > 1) text += ',';
        text += item;
    }
    return text + ']';
}

std::string matrix(const doppler::Covariance& covariance) {
    std::vector<std::string> rows;
    for (const auto& row : covariance) {
        std::vector<std::string> numbers;
        for (const double value : row) numbers.push_back(number_text(value, 12));
        rows.push_back(list(numbers));
    }
    return list(rows);
}

std::string transducer(std::size_t id, const doppler::BeamReport& beam) {
    return Object()
        .whole("id", static_cast<std::int64_t>(id))
        .number("velocity", beam.velocity, 8)
        .number("distance", beam.distance, 6)
        .number("rssi", beam.rssi, 4)
        .number("nsd", beam.nsd, 4)
        .flag("beam_valid", beam.valid)
        .text();
}

}  // namespace

std::string number_text(double value, int decimals) {
    const double scale = std::pow(10, decimals), rounded = std::round(value * scale) / scale;
    char digits[40];
    const auto end = std::to_chars(digits, digits + sizeof digits, rounded == 0 ? 0.0 : rounded).ptr;
    return {digits, end};
}

std::string ended(std::string line, const Settings& settings) {
    return line + (settings.line_feed_only ? "\n" : "\r\n");
}

std::string json_line(const VelocityReport& r, const Settings& settings) {
    std::vector<std::string> beams;
    for (std::size_t id = 0; id < r.beams.size(); ++id) beams.push_back(transducer(id, r.beams[id]));
    const bool as_water = r.water && !settings.water_as_velocity;
    return ended(Object()
                     .number("time", r.time, 6)
                     .number("vx", r.velocity.x, 8)
                     .number("vy", r.velocity.y, 8)
                     .number("vz", r.velocity.z, 8)
                     .number("fom", r.fom, 8)
                     .raw("covariance", matrix(r.covariance))
                     .number("altitude", r.altitude, 6)
                     .raw("transducers", list(beams))
                     .flag("velocity_valid", r.valid)
                     .whole("status", r.status)
                     .word("format", settings.format())
                     .word("type", as_water ? "velocity_water" : "velocity")
                     .whole("time_of_validity", r.validity)
                     .whole("time_of_transmission", r.transmission)
                     .text(),
                 settings);
}

std::string json_line(const PositionReport& r, const Settings& settings) {
    const doppler::LocalPosition& p = r.local;
    char time[32];
    std::snprintf(time, sizeof time, "%.3f", r.time);
    return ended(Object()
                     .raw("ts", time)
                     .number("x", p.position.x, 9)
                     .number("y", p.position.y, 9)
                     .number("z", p.position.z, 9)
                     .number("std", p.deviation, 9)
                     .number("roll", rad_to_deg(p.roll), 9)
                     .number("pitch", rad_to_deg(p.pitch), 9)
                     .number("yaw", rad_to_deg(p.yaw), 9)
                     .word("type", "position_local")
                     .whole("status", r.status)
                     .word("format", settings.format())
                     .text(),
                 settings);
}

}  // namespace echoloop::waterlinked_dvl
