#include "emulator/devices/imagenex-deltat/profile.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "emulator/devices/family/multibeam/bottom.h"
#include "emulator/devices/imagenex-deltat/attitude.h"
#include "emulator/devices/imagenex-deltat/smoothing.h"
#include "emulator/devices/imagenex-deltat/timestamp.h"
#include "protocols/imagenex/delta_t_codec.h"

namespace echoloop::delta_t {
namespace {

using imagenex::Profile83P;
namespace wire_bits = imagenex::delta_t;

template <class T>
T rounded(double value) {
    constexpr double most = std::numeric_limits<T>::max();
    return static_cast<T>(std::lround(std::clamp(value, 0.0, most)));
}

std::uint16_t valid_tenths(double value) {
    constexpr double most = 0x7FFF;
    return static_cast<std::uint16_t>(rounded<std::uint16_t>(std::min(10 * value, most)) | wire_bits::valid);
}

void put_settings(Profile83P& p, const PingRecord& ping, const Settings& settings) {
    const Controls& c = ping.controls;
    const Fan fan = fan_of(c);
    const unsigned steps = settings.fine_ranges ? 5000 : 500;
    p.samples = static_cast<std::uint16_t>(steps);
    p.sample_rate = settings.fine_ranges ? 1 : 0;
    p.resolution = static_cast<std::uint16_t>(1000 * c.range / steps);
    p.sector = static_cast<std::uint16_t>(c.sector);
    p.start_angle = static_cast<std::uint16_t>(fan.start + 18000);
    p.angle_increment = static_cast<std::uint8_t>(fan.increment);
    p.range = static_cast<std::uint16_t>(c.range);
    p.frequency = rounded<std::uint16_t>(settings.acoustics.frequency / 1000);
    p.sound_speed = valid_tenths(c.sound_speed);
    p.tilt = static_cast<std::uint16_t>(c.tilt + 180);
    p.ping_interval = rounded<std::uint16_t>(1e3 * ping.period);
    p.ping_number = ping.number;
    p.data_latency = rounded<std::uint16_t>(1e4 * ping.data_latency);
    p.flags = c.roll_compensation ? wire_bits::roll_corrected : 0;
    p.pings_averaged = static_cast<std::uint8_t>(c.averaging > 1 ? c.averaging : 0);
    p.centre_ping_offset = rounded<std::uint16_t>(1e4 * ping.period * (c.averaging - 1) / 2);
}

void put_attitude(Profile83P& p, const Pose& pose, Time time, const Settings& settings) {
    const auto attitude = settings.orientation ? attitude_of(pose) : std::nullopt;
    if (!attitude) return;
    const Sensors& sensors = settings.sensors;
    const double pitch = sensors.read("pitch", rad_to_deg(attitude->pitch), stray::tilt, time);
    const double roll = sensors.read("roll", rad_to_deg(attitude->roll), stray::tilt, time);
    const double heading =
        sensors.read_bearing("compass", rad_to_deg(attitude->heading), stray::compass, time);
    p.pitch = valid_tenths(pitch + 90);
    p.roll = valid_tenths(roll + 90);
    p.heading = valid_tenths(std::fmod(std::round(10 * heading), 3600) / 10);
    if (settings.floats == Floats::zeros) return;
    p.sensors = wire_bits::has_heading | wire_bits::has_roll | wire_bits::has_pitch;
    p.external_pitch = static_cast<float>(pitch);
    p.external_roll = static_cast<float>(roll);
    p.external_heading = static_cast<float>(heading);
}

/// m at 1500 m/s; 0 where there is no bottom within the range, or where its echo may be cut by the window's
/// end: then its middle is not that of the bottom.
double range_of(const multibeam::Detection& found, const Shot& shot, const Controls& controls) {
    const double end = static_cast<double>(shot.bins) * shot.bin_interval;
    const double range = found.time * nominal_sound_speed / 2;
    const bool good = found.found() && found.end < end - shot.bin_interval / 2 &&
                      range >= controls.minimum_range && range <= controls.range;
    return good ? range : 0;
}

double intensity(const multibeam::Detection& found, EchoRule rule, const Controls& controls,
                 const Settings& settings) {
    constexpr double full = 65535;
    if (rule == EchoRule::cerqueira2016) return full * found.power;
    const double range = std::max(found.time * nominal_sound_speed / 2, 1.0);
    const double spreading = settings.tvg ? 20 * std::log10(range) : 0;
    const double level = double{level_db(found.power)} + controls.gain + spreading;
    return full * std::pow(10, (level - settings.acoustics.intensity_reference) / 20);
}

std::vector<multibeam::Detection> bottom(const Echogram& echogram, const Controls& controls,
                                         const Settings& settings) {
    const double last = static_cast<double>(controls.range);
    const multibeam::TimeGate gate{2 * controls.minimum_range / nominal_sound_speed,
                                   2 * last / nominal_sound_speed + 2 * echogram.shot.pulse_length};
    const std::vector<multibeam::TimeGate> gates(echogram.beams(), gate);
    return multibeam::detect(echogram, gates, settings.acoustics.detection.with(settings.pulse));
}

}  // namespace

Profile83P make_profile(const Echogram& echogram, const PingRecord& ping, const Settings& settings) {
    Profile83P p;
    put_time(p, ping.time, settings.upper_month);
    put_settings(p, ping, settings);
    put_attitude(p, echogram.world_from_sonar, from_seconds(ping.time - settings.unix_start), settings);
    const auto detections = bottom(echogram, ping.controls, settings);
    std::vector<double> ranges;
    for (const auto& found : detections) ranges.push_back(range_of(found, echogram.shot, ping.controls));
    const auto angles = fan_of(ping.controls).angles();
    const double reach = settings.smoothing * echogram.shot.beam_width;
    const double nearest = ping.controls.minimum_range, farthest = ping.controls.range;
    for (const double range : smoothed(ranges, angles, reach)) {
        const double within = range > 0 ? std::clamp(range, nearest, std::max(nearest, farthest)) : 0;
        p.ranges.push_back(rounded<std::uint16_t>(1000 * within / p.resolution));
    }
    for (std::size_t n = 0; settings.intensity && n < ranges.size(); ++n) {
        const double echo = intensity(detections[n], echogram.rule, ping.controls, settings);
        p.intensities.push_back(ranges[n] > 0 ? rounded<std::uint16_t>(std::max(echo, 1.0)) : 0);
    }
    p.has_intensity = settings.intensity ? 1 : 0;
    if (settings.floats != Floats::zeros)
        p.altitude = static_cast<float>(multibeam::median_depth(detections, angles, nominal_sound_speed));
    return p;
}

wire::Bytes to_bytes(const Profile83P& profile, const Settings& settings) {
    return settings.floats == Floats::little ? imagenex::encode_with_little_floats(profile)
                                             : imagenex::encode(profile);
}

}  // namespace echoloop::delta_t
