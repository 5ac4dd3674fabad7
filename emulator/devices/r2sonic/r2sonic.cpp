#include "emulator/devices/r2sonic/r2sonic.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "protocols/r2sonic/codec.h"

namespace echoloop::r2sonic_device {
namespace {

using namespace std::chrono_literals;

enum PortIndex : std::size_t { head_commands, discovery, sim_commands };
enum Offset : std::uint16_t { bathymetry = 0, commands = 2, status = 2, image = 3 };

constexpr Time processing = 2ms;  // from the last sample to the datagram
constexpr Time status_period = 1s;
constexpr std::uint32_t loopback_broadcast = 0x7FFFFFFF;  // 127.255.255.255

bool is_loopback(std::uint32_t ip) { return ip >> 24 == 127; }

Address with_offset(Address base, std::uint16_t offset) {
    return {base.ip, static_cast<std::uint16_t>(base.port + offset)};
}

}  // namespace

R2Sonic::R2Sonic(const Settings& settings, const Wiring& wiring)
    : settings_(settings), wiring_(wiring), controls_(settings.start) {}

/// A loopback head hears discovery on its own address and on loopback's broadcast address; one on a real
/// interface listens everywhere, since broadcasts come to no address of its own.
std::vector<Port> R2Sonic::ports() const {
    constexpr auto datagram = Port::Kind::datagram;
    const bool local = is_loopback(wiring_.head.ip);
    const Address hears{local ? wiring_.head.ip : 0, r2sonic::discovery_port};
    std::vector<Port> ports{{"commands", datagram, with_offset(wiring_.head, commands), false},
                            {"discovery", datagram, hears, true}};
    if (wiring_.sim) ports.push_back({"SIM commands", datagram, with_offset(*wiring_.sim, commands), false});
    if (local)
        ports.push_back(
            {"discovery broadcast", datagram, {loopback_broadcast, r2sonic::discovery_port}, true});
    return ports;
}

Address R2Sonic::gui(std::uint16_t offset) const { return with_offset(wiring_.gui, offset); }

Actions R2Sonic::started(Time now) {
    next_status_ = now;
    plan_next_ping(now);
    return take_actions();
}

Actions R2Sonic::received(const Received& data, Time now) {
    if (const auto packet = r2sonic::parse(data.bytes))
        obey(*packet, data, now);
    else
        ++counters_.rejected;
    return take_actions();
}

void R2Sonic::obey(const r2sonic::Packet& packet, const Received& data, Time now) {
    ++counters_.messages;
    if (const auto* set = std::get_if<r2sonic::Cmd0>(&packet); set && data.port == head_commands)
        obey_commands(*set, now);
    else if (const auto* request = std::get_if<r2sonic::R2dd>(&packet))
        answer_discovery(*request, data.from);
    else if (const auto* config = std::get_if<r2sonic::R2dc>(&packet))
        configure(*config);
}

void R2Sonic::obey_commands(const r2sonic::Cmd0& set, Time now) {
    for (const r2sonic::Command& command : set.commands) {
        const Applied applied = apply(controls_, command);
        if (applied == Applied::ping && controls_.trigger == 2) ping_asked_ = true;
        if (applied == Applied::refused) ++counters_.rejected;
    }
    if (!ping_under_way_) plan_next_ping(now);
}

void R2Sonic::answer_discovery(const r2sonic::R2dd& request, Address from) {
    if (!settings_.answer_discovery) return;
    const Address to = settings_.discovery_to_sender ? from : Address{request.gui_ip, request.gui_port};
    send(discovery, r2sonic::R2di{settings_.serial, "15000001", settings_.model, {}}, to);
    if (wiring_.sim) send(discovery, r2sonic::R2di{settings_.sim_serial, "15000003", "SIM", {}}, to);
}

/// A head on loopback sends to loopback only, whatever the host's program says.
void R2Sonic::configure(const r2sonic::R2dc& config) {
    const bool for_sim = wiring_.sim && config.serial == settings_.sim_serial;
    if (config.serial != settings_.serial && !for_sim) return;
    (for_sim ? sim_config_ : head_config_) = config.config_id;
    if (is_loopback(wiring_.head.ip) && !is_loopback(config.gui_ip)) {
        ++counters_.rejected;
        return;
    }
    if (config.gui_port != 0) wiring_.gui = {config.gui_ip, config.gui_port};
}

void R2Sonic::plan_next_ping(Time now) {
    next_ping_ = Time::max();
    if (controls_.trigger == 1 || (controls_.trigger == 2 && !ping_asked_)) return;
    const Time period = from_seconds(ping_period(controls_, settings_));
    const Time earliest = last_transmission_ ? *last_transmission_ + period : now;
    next_ping_ = std::max(now, earliest);
}

void R2Sonic::transmit(Time now) {
    next_ping_ = Time::max();
    ping_asked_ = false;
    ping_under_way_ = true;
    ping_.period = last_transmission_ ? to_seconds(now - *last_transmission_) : 0;
    ping_.controls = controls_;
    ping_.time = unix_time(now);
    ++ping_.number;
    ping_.beams = beam_angles(controls_);
    last_transmission_ = now;
    const Time due = now + from_seconds(range_time(controls_, settings_)) + processing;
    actions_.ping = Ping{make_shot(controls_, settings_, ping_.beams, ping_.number), due};
}

Actions R2Sonic::heard(const Echogram& echogram, Time now) {
    if (!ping_under_way_ || echogram.shot.ping != ping_.number || echogram.beams() != beams)
        return take_actions();
    ping_under_way_ = false;
    ++counters_.pings;
    const double c = working_sound_speed(ping_.controls, settings_);
    const double window = static_cast<double>(echogram.shot.bins) * echogram.shot.bin_interval;
    const multibeam::Gates set = bottom_gates(ping_.controls, last_depth_);
    std::vector<multibeam::TimeGate> gates;
    for (const double angle : ping_.beams.angles)
        gates.push_back(multibeam::time_gate(set, angle, c, window));
    const auto detections =
        multibeam::detect(echogram, gates, {settings_.acoustics.detection_margin, settings_.pulse});
    const auto axis_gate = multibeam::time_gate(set, 0, c, window);
    last_depth_ = multibeam::median_depth(detections, ping_.beams.angles, c);
    send(head_commands, make_bth0(ping_, settings_, detections, axis_gate), gui(bathymetry));
    send_image(echogram, now);
    plan_next_ping(now);
    return take_actions();
}

/// Spread over time, since receivers lose bursts, but never beyond the next ping.
void R2Sonic::send_image(const Echogram& echogram, Time now) {
    const auto packets = make_image(ping_, settings_, echogram);
    if (packets.empty()) return;
    const double room = 0.8 * ping_period(ping_.controls, settings_) / static_cast<double>(packets.size());
    const Time gap = from_seconds(std::min(settings_.datagram_gap, room));
    Time when = now;
    for (const r2sonic::Packet& packet : packets) {
        send(head_commands, packet, gui(image), when);
        when += gap;
    }
}

void R2Sonic::send_status(Time now) {
    next_status_ = now + status_period;
    send(head_commands, r2sonic::R2ds{settings_.serial, head_config_, 0}, gui(status));
    if (controls_.status != 0) send(head_commands, head_status(settings_, unix_time(now)), gui(status));
    if (!wiring_.sim) return;
    send(sim_commands, r2sonic::R2ds{settings_.sim_serial, sim_config_, 0}, gui(status));
    if (controls_.status != 0) send(sim_commands, sim_status(settings_, unix_time(now)), gui(status));
}

Actions R2Sonic::woken(Time now) {
    if (now >= next_status_) send_status(now);
    if (now >= next_ping_) transmit(now);
    return take_actions();
}

void R2Sonic::send(std::size_t port, const r2sonic::Packet& packet, Address to, Time not_before) {
    actions_.send.push_back({port, r2sonic::serialise(packet), to, not_before});
}

Actions R2Sonic::take_actions() {
    actions_.wake = std::min(next_ping_, next_status_);
    return std::exchange(actions_, {});
}

}  // namespace echoloop::r2sonic_device
