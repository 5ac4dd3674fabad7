#include "emulator/devices/norbit-wbms/packets.h"

#include <cmath>
#include <limits>

#include "protocols/norbit/codec.h"

namespace echoloop::norbit_device {
namespace {

constexpr float not_measured = std::numeric_limits<float>::quiet_NaN();
constexpr double largest_byte = 255, largest_gate = 65535;

float f(double value) { return static_cast<float>(value); }

norbit::SonarMode sonar_mode(const Controls& c) {
    return c.mode == 0 ? norbit::SonarMode::forward_looking : norbit::SonarMode::bathymetry;
}

std::uint16_t gate_sample(double time, const Plan& plan) {
    return static_cast<std::uint16_t>(std::min(std::round(time * plan.sample_rate), largest_gate));
}

/// sqrt(16 x signal / noise) of amplitudes; `snr` in dB.
std::uint8_t snr_value(double snr) {
    const double value = 4 * std::pow(10.0, std::min(snr, 200.0) / 40);
    return static_cast<std::uint8_t>(std::min(std::round(value), largest_byte));
}

norbit::Point make_point(const multibeam::Detection& found, const multibeam::TimeGate& gate, double bearing,
                         const PingRecord& ping, const Settings& s) {
    norbit::Point point;
    point.angle = f(ping.plan.sign * bearing);
    point.upper_gate = gate_sample(gate.min, ping.plan);
    point.lower_gate = gate_sample(gate.max, ping.plan);
    if (!found.found()) return point;
    point.sample = static_cast<std::uint32_t>(std::lround(found.time * ping.plan.sample_rate));
    point.intensity = std::sqrt(found.power);
    if (s.newer_fields)
        point.flags = found.method == multibeam::Method::phase ? norbit::by_phase : norbit::by_magnitude;
    point.quality = norbit::snr_good;
    if (found.in_line) point.quality |= norbit::colinear;
    point.snr = snr_value(found.excess + s.acoustics.detection.margin);
    return point;
}

std::vector<norbit::Point> make_points(const PingRecord& ping, const Settings& s, const Echogram& echogram) {
    const auto found = multibeam::detect(echogram, ping.plan.gates, s.acoustics.detection.with(s.pulse));
    std::vector<norbit::Point> points;
    points.reserve(found.size());
    for (std::size_t n = 0; n < found.size(); ++n)
        points.push_back(make_point(found[n], ping.plan.gates[n], ping.plan.bearings[n], ping, s));
    return points;
}

}  // namespace

Bytes bathymetry_packet(const PingRecord& ping, const Settings& s, const Echogram& echogram, double sent) {
    const Controls& c = ping.controls;
    const Plan& plan = ping.plan;
    norbit::Bathymetry b;
    b.sound_speed = f(plan.sound_speed);
    b.sample_rate = f(plan.sample_rate);
    b.ping = ping.number;
    b.transmit_time = ping.transmitted;
    b.send_time = sent;
    b.ping_rate = f(1 / plan.period);
    b.beam_mode = s.beam_mode;
    b.sonar_mode = sonar_mode(c);
    b.tx_angle = f(deg_to_rad(c.tx_direction));
    b.intensity_gain = f(plan.digital_gain);
    b.frequency = f(1000 * c.frequency);
    b.bandwidth = f(1000 * c.bandwidth);
    b.pulse = f(1e-6 * c.pulse);
    b.tx_voltage = not_measured;
    b.swath_direction = f(plan.direction);
    b.swath_opening = f(plan.opening);
    b.gate_tilt = f(deg_to_rad(c.gate_tilt));
    if (s.newer_fields) {
        b.multi_pings = b.multi_ping = 1;
        b.raw_sound_speed =
            f(s.sensors.read("sound speed", s.sound_speed, stray::sound_speed, ping.since_start));
    }
    b.points = make_points(ping, s, echogram);
    return norbit::encode(b, s.version);
}

}  // namespace echoloop::norbit_device
