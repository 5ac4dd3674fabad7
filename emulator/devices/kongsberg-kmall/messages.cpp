#include "emulator/devices/kongsberg-kmall/messages.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "emulator/devices/kongsberg-kmall/backscatter.h"
#include "emulator/devices/kongsberg-kmall/soundings.h"

namespace echoloop::kongsberg_kmall {
namespace {

using kmall::Mrz;
using kmall::PingInfo;
using kmall::Sounding;
using kmall::TxSector;
using multibeam::Detection;

PingInfo transmission(const PingRecord& ping, const Settings& s) {
    PingInfo p;
    p.size = s.version == 0 ? 144 : 152;
    p.ping_rate = f(ping.period > 0 ? 1 / ping.period : 1 / ping_period(s));
    p.beam_spacing = s.equidistant ? 0 : 1;
    p.frequency = p.lowest_frequency = p.highest_frequency = f(s.frequency);
    p.pulse_length = p.effective_pulse_length = f(s.pulse);
    p.bandwidth = f(1 / s.pulse);
    p.absorption = f(1000 * s.absorption);
    p.port_edge = f(rad_to_deg(s.port_edge));
    p.starboard_edge = f(-rad_to_deg(s.starboard_edge));
    p.transmit_array = f(rad_to_deg(s.transmit_beam_width));
    p.receive_array = f(rad_to_deg(s.receive_beam_width));
    p.power = f(s.power);
    p.bytes_per_sector = s.version == 0 ? 36 : 48;
    p.sound_speed = f(s.sound_speed);
    p.position_info = 1;
    p.lambert = 1;
    return p;
}

/// The head is the vessel's reference point.
void add_pose(PingInfo& p, const Pose& pose, const Surface& surface, Time time, const Settings& s) {
    const auto read = s.sensors.at(time);
    const double heading = rad_to_deg(surface.heading);
    const GeoPlace place = place_from_enu(
        {s.latitude, s.longitude},
        {read("east", pose.position.x, stray::position), read("north", pose.position.y, stray::position), 0});
    p.heading =
        f(s.sensors.read_bearing("compass", heading < 0 ? heading + 360 : heading, stray::heading, time));
    p.transducer_depth = read("depth", -pose.position.z, stray::depth);
    p.water_level = 0 - p.transducer_depth;
    p.latitude = place.latitude;
    p.longitude = place.longitude;
    p.height = read("height", pose.position.z, stray::position);
}

/// Between the reference points of two formats lies the position's antenna, projected on the still water line
/// and turned with the vessel: so 23 pings of an EM 2040P (within 1 um of a straight line over roll and
/// pitch) and single ones of an EM 2042, by the numbers of their #IIP. The antenna is the head here, and the
/// still water line that of the ping.
void add_offsets(PingInfo& p, const Surface& surface) {
    const Vec3 offset = surface.from_world(static_cast<double>(p.water_level) * surface.keel);
    p.x_offset = f(offset.x);
    p.y_offset = f(offset.y);
}

/// A real one tells the range of the bottom as its focus.
TxSector sector(const Settings& s, std::span<const Detection> detections) {
    double nearest = 0;
    for (const Detection& d : detections)
        if (d.found() && (nearest == 0 || d.time < nearest)) nearest = d.time;
    TxSector t;
    t.focus_range = f(nearest * s.sound_speed / 2);
    t.sub_array = 1;
    t.source_level = f(s.source_level);
    t.frequency = f(s.frequency);
    t.bandwidth = f(1 / s.pulse);
    t.pulse_length = t.effective_pulse_length = f(s.pulse);
    return t;
}

/// What is told anew of each ping, though nobody set it: within 0.0033 dB and 0.006 dB/km in 25 pings of an
/// EM 2040.
void add_measured(Mrz& m, Time time, const Settings& s) {
    const auto read = s.sensors.at(time);
    const float level = read("source level", 0, {.drift = 0.0005, .noise = 0.001}),
                absorption = read("absorption", 0, {.drift = 0.001, .noise = 0.002});
    for (TxSector& sector : m.sectors) sector.source_level += level;
    for (Sounding& one : m.soundings) {
        one.source_level += level;
        one.absorption += absorption;
    }
}

/// Outermost of the valid soundings: angles positive to port like all, metres to starboard like y.
void add_coverage(Mrz& m) {
    const auto port = std::find_if(m.soundings.begin(), m.soundings.end(), is_valid);
    if (port == m.soundings.end()) return;
    const auto starboard = std::find_if(m.soundings.rbegin(), m.soundings.rend(), is_valid);
    const auto metres = [](float y) {
        return static_cast<std::int16_t>(std::lround(std::clamp(y, -32768.0F, 32767.0F)));
    };
    m.ping.port_coverage = port->water_angle;
    m.ping.starboard_coverage = starboard->water_angle;
    m.ping.port_coverage_m = metres(port->y);
    m.ping.starboard_coverage_m = metres(starboard->y);
}

}  // namespace

double gain(const Settings& settings, double x, double r) {
    if (!settings.tvg) return 0;
    return x * std::log10(std::max(r, 1.0)) + 2 * settings.absorption * r;
}

kmall::Header make_header(const PingRecord& ping, const Settings& settings, const char* type,
                          std::uint8_t version) {
    kmall::Header h;
    h.type = type;
    h.version = version;
    h.system_id = settings.system_id;
    h.sounder = settings.sounder;
    h.seconds = static_cast<std::uint32_t>(ping.time);
    h.nanoseconds = static_cast<std::uint32_t>((ping.time - std::floor(ping.time)) * 1e9);
    return h;
}

kmall::Body make_body(const PingRecord& ping) {
    kmall::Body body;
    body.ping = ping.number;
    body.fans_per_ping = body.swaths_per_ping = body.rx_transducers = 1;
    return body;
}

Mrz make_mrz(const PingRecord& ping, const Settings& settings, const Echogram& echogram,
             std::span<const Detection> detections) {
    const Pose& pose = echogram.world_from_sonar;
    const Surface surface = surface_of(pose);
    Mrz m;
    m.header = make_header(ping, settings, "#MRZ", settings.version);
    m.body = make_body(ping);
    m.ping = transmission(ping, settings);
    add_pose(m.ping, pose, surface, from_seconds(ping.time - settings.unix_start), settings);
    m.sectors = {sector(settings, detections)};
    m.rx.water_column_rate = f(1 / (bins_per_sample * echogram.shot.bin_interval));
    m.rx.seabed_image_rate = m.rx.water_column_rate;  // as in all real ones
    std::vector<Vec3> directions;
    for (std::size_t n = 0; n < detections.size(); ++n) {
        const double bearing = echogram.shot.bearings[n];
        const Vec3 direction = beam_direction(pose, surface, bearing);
        Sounding one = beam(settings, n, bearing, direction);
        if (detections[n].found()) {
            add_bottom(one, detections[n], m.rx.water_column_rate);
            add_place(one, detections[n].time * settings.sound_speed / 2 * direction, surface, settings,
                      detections[n].power / detections[n].mean);
            ++m.rx.valid;
        }
        m.soundings.push_back(one);
        directions.push_back(direction);
    }
    if (m.rx.valid > 0) add_offsets(m.ping, surface);  // 0 in pings of an EM 2042 without a bottom
    place_rejected(m, directions, surface, settings);
    add_coverage(m);
    add_extra_detections(m, settings, echogram, detections);
    add_backscatter(m, settings, echogram, detections);
    classify_extra_detections(m);
    add_measured(m, from_seconds(ping.time - settings.unix_start), settings);
    return m;
}

std::optional<double> depth_below(const Mrz& bathymetry) {
    const Sounding* nearest = nullptr;
    const auto off_vertical = [](const Sounding& one) { return std::hypot(one.x, one.y) / one.z; };
    for (const Sounding& one : bathymetry.soundings) {
        const bool below = one.type == 0 && one.z > 0;
        if (below && (nearest == nullptr || off_vertical(one) < off_vertical(*nearest))) nearest = &one;
    }
    return nearest == nullptr ? std::nullopt : std::optional<double>(nearest->z);
}

kmall::PingHeave make_heave(const PingRecord& ping, const Settings& settings) {
    return {make_header(ping, settings, "#CHE", 0), make_body(ping), {f(ping.heave)}};
}

}  // namespace echoloop::kongsberg_kmall
