#include "emulator/devices/oculus/messages.h"

#include <algorithm>
#include <cmath>

#include "emulator/devices/oculus/image.h"
#include "protocols/oculus/codec.h"

namespace echoloop::oculus_device {
namespace {

/// Above that of the air, bar.
double pressure_at(double depth) {
    constexpr double density = 1025, gravity = 9.80665;
    return std::max(0.0, depth) * density * gravity * 1e-5;
}

/// Heading clockwise from north, pitch nose up, roll starboard down, deg.
struct Attitude {
    double heading, pitch, roll;
};
Attitude attitude_of(const Quat& world_from_sonar, const Sensors& sensors, Time time) {
    const Vec3 ahead = rotate(world_from_sonar, {1, 0, 0}), port = rotate(world_from_sonar, {0, 1, 0});
    const Vec3 up = rotate(world_from_sonar, {0, 0, 1});
    const double heading = rad_to_deg(std::atan2(ahead.x, ahead.y)),
                 pitch = rad_to_deg(std::asin(std::clamp(ahead.z, -1.0, 1.0))),
                 roll = rad_to_deg(std::atan2(port.z, up.z));
    return {sensors.read_bearing("compass", heading < 0 ? heading + 360 : heading, stray::compass, time),
            sensors.read("pitch", pitch, stray::tilt, time), sensors.read("roll", roll, stray::tilt, time)};
}

/// The request as it came, but for what real units change.
oculus::Fire echo_of(const PingRecord& ping, const Settings& settings) {
    constexpr std::uint8_t useless = 195;  // of a real unit
    oculus::Fire echo = ping.request.fire();
    if (ping.request.high() && settings.scaled_gain_echo) echo.gain = ping.plan.gain;
    if (settings.echo_used_sound_speed) echo.sound_speed = ping.plan.sound_speed;
    if (settings.useless_rate_echo) echo.rate = static_cast<oculus::Rate>(useless);
    return echo;
}

/// bar, at `depth` m.
double read_pressure(const Settings& settings, double depth, Time time) {
    return pressure_at(settings.sensors.read("pressure", depth, stray::depth, time));
}

/// What both versions have.
template <class Result>
void fill(Result& result, const PingRecord& ping, const Settings& settings, const Echogram& echogram) {
    result.ping_id = ping.number;
    result.frequency = echogram.shot.frequency;
    result.temperature = settings.garbage_sensors ? 1e-76 : water_temperature(settings, ping.time);
    result.pressure = settings.garbage_sensors
                          ? -1e194
                          : read_pressure(settings, -echogram.world_from_sonar.position.z, ping.time);
    result.sound_speed = ping.plan.sound_speed;
    result.data_size = ping.plan.data_size;
    result.range_resolution = ping.plan.resolution();
    result.ranges = static_cast<std::uint16_t>(ping.plan.rows);
    result.bearings.reserve(ping.plan.beams);
    for (const double bearing : echogram.shot.bearings)
        result.bearings.push_back(oculus::wire_bearing(bearing));
}

template <class Result>
Bytes with_image(Result& result, const PingRecord& ping, const Settings& settings, const Echogram& echogram) {
    Bytes bytes = oculus::encode_around_image(result, settings.message_id);
    write_image(echogram, ping.request, ping.plan, settings,
                std::span(bytes).subspan(result.image_offset, result.image_size));
    return bytes;
}

}  // namespace

Bytes make_result(const PingRecord& ping, const Settings& settings, const Echogram& echogram) {
    if (!ping.request.v2) {
        oculus::ResultV1 result;
        result.fire = echo_of(ping, settings);
        result.start_time = static_cast<std::uint32_t>(ping.time.count());
        fill(result, ping, settings, echogram);
        return with_image(result, ping, settings, echogram);
    }
    oculus::ResultV2 result;
    result.fire = ping.request.wish;
    result.fire.fire = echo_of(ping, settings);
    result.start_time = to_seconds(ping.time);
    const Attitude attitude = attitude_of(echogram.world_from_sonar.orientation, settings.sensors, ping.time);
    result.heading = attitude.heading;
    result.pitch = attitude.pitch;
    result.roll = attitude.roll;
    fill(result, ping, settings, echogram);
    return with_image(result, ping, settings, echogram);
}

Bytes make_status(const Settings& settings, std::uint32_t own, std::uint32_t client, double depth, Time now) {
    constexpr std::uint16_t everybody = 0xFFFF;
    constexpr std::uint32_t version = 0x00000101, date = 0x20200101;  // own choice: 1.1.0
    oculus::Status status;
    status.device_id = settings.device_id;
    status.part_number = settings.part_number;
    status.bits = settings.status_bits;
    status.firmware0 = status.firmware1 = status.bit_file = {version, date};
    status.ip = to_ipv4(own);
    status.mask = settings.mask;
    status.client_ip = to_ipv4(client);
    // Locally administered, one for each device id.
    status.mac = {0x02,
                  0x4F,
                  0x43,
                  0x55,
                  static_cast<std::uint8_t>(settings.device_id >> 8),
                  static_cast<std::uint8_t>(settings.device_id & 0xFF)};
    char place = '1';
    for (double& one : status.temperatures)
        one = settings.sensors.read(std::string("board ") + place++, settings.temperature,
                                    stray::board_temperature, now);
    status.pressure = read_pressure(settings, depth, now);
    return oculus::encode(status, settings.device_id, everybody, static_cast<oculus::Id>(settings.status_id));
}

Bytes make_dummy(const Settings& settings) { return oculus::encode(oculus::Dummy{}, settings.message_id); }

}  // namespace echoloop::oculus_device
