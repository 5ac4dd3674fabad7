#include "emulator/devices/surveyor240/messages.h"

#include <cmath>

namespace echoloop::surveyor240 {
namespace {

float f(double value) { return static_cast<float>(value); }

}  // namespace

double slant_range(const Point& point, const Plan& plan) { return point.time * plan.sound_speed / 2; }

cerulean::surveyor::AtofPointData atof_message(const PingRecord& ping, const std::vector<Point>& points) {
    cerulean::surveyor::AtofPointData message;
    message.pwr_up_msec = ping.at;
    message.utc_msec = ping.utc;
    message.listening_sec = f(ping.plan.listening());
    message.sos_mps = f(ping.plan.sound_speed);
    message.ping_number = ping.number;
    message.ping_hz = static_cast<std::uint32_t>(ping.plan.frequency);
    message.pulse_sec = f(ping.plan.pulse);
    for (const Point& point : points) message.atof_point_data.push_back({f(point.angle), f(point.time), {}});
    return message;
}

cerulean::surveyor::YzPointData yz_message(const PingRecord& ping, const std::vector<Point>& points) {
    cerulean::surveyor::YzPointData message;
    message.timestamp_msec = ping.at;
    message.ping_number = ping.number;
    message.sos_mps = f(ping.plan.sound_speed);
    message.up_vec = ping.up;
    message.water_degC = ping.water.temperature;
    message.water_bar = ping.water.pressure;
    message.start_m = f(ping.plan.start);
    message.end_m = f(ping.plan.end);
    for (const Point& point : points) {
        const double range = slant_range(point, ping.plan);
        message.yz_point_data.push_back(
            {f(range * std::sin(point.angle)), f(-range * std::cos(point.angle))});
    }
    return message;
}

}  // namespace echoloop::surveyor240
