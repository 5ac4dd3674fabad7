#include "emulator/devices/r2sonic/packets.h"

#include <algorithm>
#include <cmath>

#include "emulator/devices/r2sonic/levels.h"
#include "protocols/r2sonic/beams.h"

namespace echoloop::r2sonic_device {
namespace {

using multibeam::Detection;

const float time_step = static_cast<float>(1 / (4 * sample_rate));  // R0's scale in all real pings

/// The magnitudes of the echoes, as SNI0 has them, each averaged over its footprint. The scale is 1 in all
/// real pings.
r2sonic::I1 make_intensities(const PingRecord& ping, const Settings& settings, const Echogram& echogram,
                             const std::vector<Detection>& detections) {
    const auto gain = gain_curve(ping.controls, settings, echogram, settings.acoustics.magnitude_reference);
    const bool paper = echogram.rule == EchoRule::cerqueira2016;
    std::vector<float> amplitude;
    for (const Detection& d : detections) {
        const double bin = (d.time - echogram.shot.first_bin_time) / echogram.shot.bin_interval;
        const auto last = static_cast<double>(gain.size() - 1);
        const float factor = gain[static_cast<std::size_t>(std::clamp(bin, 0.0, last))];
        amplitude.push_back(paper ? d.mean : std::sqrt(d.mean * factor));
    }
    r2sonic::I1 section;
    section.scale = 1;
    section.intensity.resize(amplitude.size());
    quantise(amplitude.data(), amplitude.size(), section.intensity.data());
    return section;
}

/// Bits of Q0. The bright are those that stand well above the least that is a bottom.
std::uint8_t quality_nibble(const Detection& d, TestBits tests) {
    namespace quality = r2sonic::quality;
    if (!d.found()) return 0;
    std::uint8_t bits = d.method == multibeam::Method::phase ? quality::phase : quality::magnitude;
    if (tests == TestBits::clear) return bits;
    if (tests == TestBits::set || d.in_line) bits |= quality::colinearity;
    if (tests == TestBits::set || d.excess > 10) bits |= quality::brightness;
    return bits;
}

/// All gates in steps of the largest.
r2sonic::G1 make_gates(const std::vector<multibeam::TimeGate>& gates) {
    double longest = 0;
    for (const auto& gate : gates) longest = std::max(longest, gate.max);
    r2sonic::G1 section;
    section.scale = static_cast<float>(longest / 255);
    const auto steps = [&](double time) {
        return static_cast<std::uint8_t>(longest > 0 ? std::lround(std::clamp(time / longest, 0.0, 1.0) * 255)
                                                     : 0);
    };
    for (const auto& gate : gates) section.gate.push_back({steps(gate.min), steps(gate.max)});
    return section;
}

/// 0.01 dB. Of 20 real pings it falls by 0.0078 dB from ping to ping, and starts anew at -0.04 dB once it is
/// below -0.24.
std::int16_t transmit_voltage(const Sensors& sensors, Time now) {
    constexpr double mean = -15, fall = 20, period = 1.36;  // s
    const double part = std::fmod(to_seconds(now), period) / period;
    return static_cast<std::int16_t>(std::lround(sensors.read("transmitter", mean, {.noise = 0.7}, now) +
                                                 sensors.swing(fall * (0.5 - part))));
}

}  // namespace

r2sonic::H0 make_h0(const PingRecord& ping, const Settings& settings) {
    const Controls& c = ping.controls;
    const auto f = [](double value) { return static_cast<float>(value); };
    r2sonic::H0 h;
    h.model = settings.model;
    h.serial = settings.serial;
    h.ping_seconds = static_cast<std::uint32_t>(ping.time);
    h.ping_nanoseconds = static_cast<std::uint32_t>((ping.time - std::floor(ping.time)) * 1e9);
    h.ping_number = ping.number;
    h.ping_period = f(ping.period);
    h.sound_speed = f(shown_sound_speed(c, settings, ping.since_start));
    h.frequency = f(c.frequency);
    h.tx_power = f(c.power);
    h.tx_pulse_width = f(c.pulse);
    h.tx_beam_width_vertical = f(transmit_beam_width(c, settings.acoustics));
    h.tx_steering_vertical = f(steering(c, ping.attitude.pitch));
    h.tx_beam_width_horizontal = f(receive_beam_width(c, settings.acoustics));
    if (settings.variant->has_thermometer) {
        // Real pings have 291.7 to 291.8 K and -0.26 to -0.03 dB.
        const double projector =
            settings.sensors.read("projector", 29175, 100 * stray::water_temperature, ping.since_start);
        h.projector_temperature = static_cast<std::uint16_t>(std::lround(projector));
        h.vtx_offset = transmit_voltage(settings.sensors, ping.since_start);
    }
    h.rx_bandwidth = f(settings.acoustics.receiver.bandwidth);
    h.rx_sample_rate = f(sample_rate);
    h.rx_range = f(c.range);
    h.rx_gain = f(c.gain);
    h.rx_spreading = f(c.spreading);
    h.rx_absorption = f(c.absorption);
    h.rx_mount_tilt = f(c.receiver_tilt);
    return h;
}

r2sonic::H0 make_h0(const PingRecord& ping, const Settings& settings, const Echogram& echogram) {
    r2sonic::H0 h = make_h0(ping, settings);
    h.rx_sample_rate = static_cast<float>(1 / echogram.shot.bin_interval);
    return h;
}

std::vector<std::size_t> shown_beams(std::size_t beams) {
    constexpr std::size_t most = 256;
    std::vector<std::size_t> shown(std::min(beams, most));
    for (std::size_t i = 0; i < shown.size(); ++i)
        shown[i] = beams <= most ? i : (i * (beams - 1) + (most - 1) / 2) / (most - 1);
    return shown;
}

r2sonic::A1 make_a1(const PingRecord& ping, const std::vector<std::size_t>& shown) {
    r2sonic::A1 section;
    section.more = more_of(ping.beams);
    for (const std::size_t beam : shown) section.angle.push_back(static_cast<float>(ping.beams.angles[beam]));
    return section;
}

r2sonic::Bth0 make_bth0(const PingRecord& ping, const Settings& settings, const Echogram& echogram,
                        const std::vector<Detection>& detections,
                        const std::vector<multibeam::TimeGate>& gates, const r2sonic::G0& gate) {
    r2sonic::Bth0 packet;
    packet.h0 = make_h0(ping, settings);
    packet.h0.reserved108 = 3;  // in all real ones, 0 in real AID0
    packet.angles = ping.beams.section;
    std::vector<double> times;
    std::vector<std::uint8_t> nibbles;
    for (const Detection& d : detections) {
        times.push_back(d.time);
        nibbles.push_back(quality_nibble(d, settings.test_bits));
    }
    // A window longer than 65535 steps needs a coarser scale.
    const double longest = *std::max_element(times.begin(), times.end());
    packet.r0 = r2sonic::pack_times(times, std::max(time_step, static_cast<float>(longest / 65535.0)));
    if (ping.controls.intensity) packet.i1 = make_intensities(ping, settings, echogram, detections);
    packet.g0 = gate;
    if (settings.verbose_gates) packet.g1 = make_gates(gates);
    packet.q0 = r2sonic::pack_quality(nibbles);
    return packet;
}

}  // namespace echoloop::r2sonic_device
