#include "emulator/devices/reson-7k/records.h"

#include <algorithm>
#include <cmath>

namespace echoloop::reson7k_device {
namespace {

constexpr float to_f32(double value) { return static_cast<float>(value); }

constexpr std::uint32_t time_ok = 3U << 27, active = 1U << 15, range_filter = 1U << 8, depth_filter = 1U << 9,
                        fixed_gain = 1U << 11;

/// Without a time-varied gain the gain is fixed.
std::uint32_t control_flags(const Controls& c, const Settings& settings) {
    return time_ok | (settings.tvg ? 0 : fixed_gain) | (c.pinging ? active : 0) |
           (c.range_filter ? range_filter : 0) | (c.depth_filter ? depth_filter : 0);
}

reson7k::Conditions conditions_of(const Controls& c, const Settings& settings) {
    reson7k::Conditions now;
    now.min_range = to_f32(c.min_range);
    now.max_range = to_f32(c.max_range);
    now.min_depth = to_f32(c.min_depth);
    now.max_depth = to_f32(c.max_depth);
    now.absorption = to_f32(settings.tvg ? c.absorption : 0);
    now.sound_speed = to_f32(c.sound_speed);
    now.spreading = to_f32(settings.tvg ? c.spreading : 0);
    return now;
}

float receive_width(const Controls& c, const Settings& settings) {
    return to_f32(width_factor(c, settings) * settings.acoustics.receive_beam_width);
}
float receive_fan(const Controls& c, const Settings& settings) {
    return to_f32(width_factor(c, settings) * settings.acoustics.receive_fan);
}
float transmit_width(const Controls& c, const Settings& settings) {
    return to_f32(width_factor(c, settings) * settings.acoustics.transmit_beam_width);
}

reson7k::Settings settings_of(const PingRecord& ping, const Settings& settings) {
    const Acoustics& a = settings.acoustics;
    const Controls& c = ping.controls;
    reson7k::Settings s;
    s.frequency = to_f32(c.frequency);
    s.sample_rate = to_f32(sample_rate(c, settings));
    s.receiver_bandwidth = to_f32(a.receiver.bandwidth);
    s.pulse = to_f32(c.pulse);
    s.max_rate = to_f32(c.max_rate);
    s.period = to_f32(ping.since_last);
    s.range = to_f32(c.range);
    s.power = to_f32(c.power);
    s.gain = to_f32(c.gain);
    s.control = control_flags(c, settings);
    s.tx_width_vertical = transmit_width(c, settings);
    s.tx_width_horizontal = to_f32(a.transmit_sector);
    return s;
}

std::uint32_t quality_of(const multibeam::Detection& detection) {
    constexpr float bright = 10;  // dB above the least that counts as a bottom, own choice
    return (detection.excess > bright ? reson7k::detection::bright : 0) |
           (detection.in_line ? reson7k::detection::in_line : 0);
}

/// As 7018 has it: a host takes the gains off again.
float intensity_of(const multibeam::Detection& detection, std::span<const float> gain,
                   const Echogram& echogram) {
    const double bin = std::max(0.0, detection.time / echogram.shot.bin_interval);
    const std::size_t at = std::min(static_cast<std::size_t>(bin), gain.size() - 1);
    return full_scale * to_share(detection.power, gain[at], echogram.rule == EchoRule::cerqueira2016);
}

}  // namespace

reson7k::RecordFrame frame_of(const Settings& settings, double unix_time) {
    reson7k::RecordFrame frame;
    frame.device = settings.device;
    frame.time = reson7k::to_time(unix_time);
    return frame;
}

reson7k::SonarSettings make_settings(const PingRecord& ping, const Settings& settings) {
    const Controls& c = ping.controls;
    return {settings.serial,
            ping.number,
            0,
            settings_of(ping, settings),
            receive_width(c, settings),
            conditions_of(c, settings),
            0};
}

reson7k::RemoteSettings make_remote_settings(const PingRecord& ping, const Settings& settings) {
    const Controls& c = ping.controls;
    reson7k::RemoteExtras extras;
    extras.ping_state = c.pinging ? 1 : 0;
    extras.custom_beams = static_cast<std::uint16_t>(settings.beams);
    extras.coverage = to_f32(settings.swath);
    extras.gate_tilt = to_f32(c.gate_tilt);
    extras.applied_frequency = to_f32(c.frequency);
    return {settings.serial, ping.number, settings_of(ping, settings), conditions_of(c, settings),
            extras,          {}};
}

reson7k::BeamGeometry make_geometry(const Controls& controls, const Settings& settings) {
    const auto angles = beam_angles(settings);
    reson7k::BeamGeometry g;
    g.serial = settings.serial;
    g.along.assign(angles.size(), 0.0F);
    g.across.assign(angles.begin(), angles.end());
    g.width_y.assign(angles.size(), receive_fan(controls, settings));
    g.width_x.assign(angles.size(), receive_width(controls, settings));
    return g;
}

reson7k::RawDetections make_detections(const PingRecord& ping, const Settings& settings,
                                       const Echogram& echogram) {
    const auto& angles = echogram.shot.bearings;
    std::vector<multibeam::TimeGate> gates;
    for (const double angle : angles) gates.push_back(bottom_gate(ping.controls, angle));
    const auto found = multibeam::detect(echogram, gates, settings.acoustics.detection.with(settings.pulse));
    const double rate = sample_rate(ping.controls, settings);
    reson7k::RawDetections record;
    record.serial = settings.serial;
    record.ping = ping.number;
    record.sample_rate = to_f32(rate);
    const auto gain = gain_curve(ping, settings, echogram);
    for (std::size_t n = 0; n < found.size(); ++n) {
        if (!found[n].found()) continue;
        const bool by_phase = found[n].method == multibeam::Method::phase;
        record.detections.push_back({static_cast<std::uint16_t>(n), to_f32(found[n].time * rate),
                                     to_f32(angles[n]),
                                     (by_phase ? reson7k::detection::phase : reson7k::detection::magnitude) |
                                         reson7k::detection::quality_type_1,
                                     quality_of(found[n]), 0, intensity_of(found[n], gain, echogram),
                                     to_f32(gates[n].min * rate), to_f32(gates[n].max * rate)});
    }
    return record;
}

}  // namespace echoloop::reson7k_device
