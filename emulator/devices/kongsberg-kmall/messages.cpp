#include "emulator/devices/kongsberg-kmall/messages.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace echoloop::kongsberg_kmall {
namespace {

using kmall::Mrz;
using kmall::PingInfo;
using kmall::RxInfo;
using kmall::Sounding;
using kmall::TxSector;
using multibeam::Detection;

constexpr double metres_per_degree = 60 * 1852;  // own choice: a sphere
constexpr double spreading = 40;                 // X of the gain of reflectivities

constexpr std::uint8_t no_bottom = 15;  // rejectionInfo1 of every rejected sounding of an EM 2042's files

float f(double value) { return static_cast<float>(value); }

/// Metres to starboard to degrees of longitude, and so on.
struct Degrees {
    double latitude = 0, longitude = 0;
};
Degrees degrees_of(double east, double north, const Settings& s) {
    return {north / metres_per_degree, east / (metres_per_degree * std::cos(deg_to_rad(s.latitude)))};
}

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
    return p;
}

/// The head is the vessel's reference point.
void add_pose(PingInfo& p, const Pose& pose, const Surface& surface, Time time, const Settings& s) {
    const auto read = s.sensors.at(time);
    const double heading = rad_to_deg(surface.heading);
    const Degrees moved = degrees_of(read("east", pose.position.x, stray::position),
                                     read("north", pose.position.y, stray::position), s);
    p.heading =
        f(s.sensors.read_bearing("compass", heading < 0 ? heading + 360 : heading, stray::heading, time));
    p.transducer_depth = read("depth", -pose.position.z, stray::depth);
    p.water_level = 0 - p.transducer_depth;
    p.latitude = s.latitude + moved.latitude;
    p.longitude = s.longitude + moved.longitude;
    p.height = read("height", pose.position.z, stray::position);
}

TxSector sector(const Settings& s) {
    TxSector t;
    t.sub_array = 1;
    t.source_level = f(s.source_level);
    t.frequency = f(s.frequency);
    t.bandwidth = f(1 / s.pulse);
    t.pulse_length = t.effective_pulse_length = f(s.pulse);
    return t;
}

/// What is known of every beam.
Sounding beam(const Settings& s, std::size_t index, double bearing, Vec3 direction) {
    Sounding out;
    out.index = out.water_beam = static_cast<std::uint16_t>(index);
    out.type = 2;
    out.rejection1 = no_bottom;
    out.water_angle = f(rad_to_deg(std::atan2(-direction.y, direction.z)));
    out.absorption = f(1000 * s.absorption);
    out.source_level = f(s.source_level + s.power);
    out.angle = f(-rad_to_deg(bearing));
    return out;
}

void add_bottom(Sounding& out, const Detection& d, const Settings& s, const Shot& shot) {
    const double range = d.time * s.sound_speed / 2;
    out.type = out.rejection1 = 0;
    out.method = d.method == multibeam::Method::phase ? 2 : 1;
    out.confidence = static_cast<std::uint8_t>(std::clamp(d.excess, 0.0F, 100.0F));
    out.range_factor = 100;
    out.window = out.echo_length = f(d.end - d.begin);
    const double sample = bins_per_sample * shot.bin_interval;
    out.water_range = static_cast<std::uint16_t>(std::min(d.time / sample, 65535.0));
    out.tvg = f(gain(s, spreading, range));
    out.reflectivity1 = out.reflectivity2 = level_db(d.power) - out.source_level + out.tvg;
    out.time = f(d.time);
}

void add_place(Sounding& out, Vec3 place, const Surface& surface, const Settings& s) {
    const Vec3 world = place.x * surface.ahead + place.y * surface.starboard;
    const Degrees moved = degrees_of(world.x, world.y, s);
    out.delta_latitude = f(moved.latitude);
    out.delta_longitude = f(moved.longitude);
    out.x = f(place.x);
    out.y = f(place.y);
    out.z = f(place.z);
    // An even error of one pulse length, own choice.
    out.vertical_uncertainty = f(s.sound_speed * s.pulse / 2 / std::sqrt(12.0));
    out.horizontal_uncertainty = out.vertical_uncertainty;
    if (place.z > 0) out.quality = f(100 * out.vertical_uncertainty / place.z);
}

bool is_valid(const Sounding& one) { return one.type == 0; }

/// Depth of the bottom at sounding `n` by the valid ones, whose numbers these are: evenly between two, level
/// beyond the outermost.
double depth_between(std::span<const std::size_t> valid, std::size_t n, std::span<const Sounding> soundings) {
    const auto after = std::upper_bound(valid.begin(), valid.end(), n);
    if (after == valid.begin()) return soundings[valid.front()].z;
    if (after == valid.end()) return soundings[valid.back()].z;
    const std::size_t left = after[-1], right = after[0];
    const double part = static_cast<double>(n - left) / static_cast<double>(right - left);
    return std::lerp(static_cast<double>(soundings[left].z), static_cast<double>(soundings[right].z), part);
}

/// Soundings without a bottom get a place, too, as in the files of real heads: where the bottom of the others
/// goes on. Not those that look along the surface or up.
void place_rejected(Mrz& m, std::span<const Vec3> directions, const Surface& surface, const Settings& s) {
    constexpr double least_down = 0.1;
    std::vector<std::size_t> valid;
    for (std::size_t n = 0; n < m.soundings.size(); ++n)
        if (is_valid(m.soundings[n])) valid.push_back(n);
    if (valid.empty()) return;
    for (std::size_t n = 0; n < m.soundings.size(); ++n) {
        Sounding& one = m.soundings[n];
        if (is_valid(one) || directions[n].z < least_down) continue;
        const double range = depth_between(valid, n, m.soundings) / directions[n].z;
        if (range <= 0) continue;  // the others see what lies above them
        one.range_factor = 100;
        one.time = f(2 * range / s.sound_speed);
        add_place(one, range * directions[n], surface, s);
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
    m.sectors = {sector(settings)};
    m.rx.water_column_rate = f(1 / (bins_per_sample * echogram.shot.bin_interval));
    m.rx.seabed_image_rate = f(1 / echogram.shot.bin_interval);
    std::vector<Vec3> directions;
    for (std::size_t n = 0; n < detections.size(); ++n) {
        const double bearing = echogram.shot.bearings[n];
        const Vec3 direction = beam_direction(pose, surface, bearing);
        Sounding one = beam(settings, n, bearing, direction);
        if (detections[n].found()) {
            add_bottom(one, detections[n], settings, echogram.shot);
            add_place(one, detections[n].time * settings.sound_speed / 2 * direction, surface, settings);
            ++m.rx.valid;
        }
        m.soundings.push_back(one);
        directions.push_back(direction);
    }
    place_rejected(m, directions, surface, settings);
    add_coverage(m);
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

}  // namespace echoloop::kongsberg_kmall
