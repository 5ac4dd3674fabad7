#include "emulator/devices/reson-7k/ship_sensors.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace echoloop::reson7k_device {
namespace {

// Rates are own choices: logs have 1012 and 1013 at that of the motion unit, and 1003 at that of the
// receiver.
constexpr Time tick = std::chrono::milliseconds(20);
constexpr std::uint64_t ticks_per_position = 10;
constexpr std::size_t samples_per_attitude = 10;

constexpr std::uint8_t fixed = 15;  // real-time kinematic
constexpr std::uint8_t satellites = 12;

float rad(double degrees) { return static_cast<float>(deg_to_rad(degrees)); }

reson7k::Position position_of(const survey::Reading& r) {
    reson7k::Position p;
    p.latitude = deg_to_rad(r.place.latitude);
    p.longitude = deg_to_rad(r.place.longitude);
    p.height = r.place.height;
    p.method = fixed;
    p.satellites = satellites;
    return p;
}

}  // namespace

std::span<const std::uint32_t> motion_records() {
    static constexpr std::uint32_t types[] = {reson7k::Position::type, reson7k::RollPitchHeave::type,
                                              reson7k::ShipHeading::type, reson7k::Attitude::type};
    return types;
}

std::vector<Time> ShipSensors::moments(Time now) {
    constexpr std::int64_t most = 50;
    next_ = std::max(next_, now - most * tick);
    std::vector<Time> times;
    for (; next_ <= now; next_ += tick) times.push_back(next_);
    return times;
}

std::vector<SensorRecord> ShipSensors::records(std::span<const Located> places, double unix_start) {
    std::vector<SensorRecord> out;
    for (const Located& place : places) {
        const survey::Reading r = unit_.read(place);
        const double time = unix_start + to_seconds(place.time);
        const auto heave = static_cast<float>(-r.heave);
        if (ticks_++ % ticks_per_position == 0) out.push_back({position_of(r), time});
        out.push_back({reson7k::RollPitchHeave{rad(r.roll), rad(r.pitch), heave}, time});
        out.push_back({reson7k::ShipHeading{rad(r.heading)}, time});
        if (attitude_.samples.empty()) attitude_from_ = time;
        const auto after = static_cast<std::uint16_t>(std::lround(1000 * (time - attitude_from_)));
        attitude_.samples.push_back({after, rad(r.roll), rad(r.pitch), heave, rad(r.heading)});
        if (attitude_.samples.size() == samples_per_attitude)
            out.push_back({std::exchange(attitude_, {}), attitude_from_});
    }
    return out;
}

}  // namespace echoloop::reson7k_device
