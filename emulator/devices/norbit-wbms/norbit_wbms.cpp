#include "emulator/devices/norbit-wbms/norbit_wbms.h"

#include <algorithm>
#include <utility>

#include "protocols/norbit/codec.h"

namespace echoloop::norbit_device {
namespace {

enum PortIndex : std::size_t { command_port, bathymetry_port, water_column_port };

/// What a real 10.3.6 shows to who connects, TN-180197 1D page 5. Public drivers wait for it.
Bytes greeting(const Settings& settings) {
    const std::string text = "Welcome to WHI\r\n\r\n" + settings.revision +
                             " release\r\n\r\n Version: 4.7.343\r\n\r\n Compiled:Oct 18 2018 19:34:31\r\n";
    return {text.begin(), text.end()};
}

}  // namespace

NorbitWbms::NorbitWbms(const Settings& settings)
    : settings_(settings), controls_(initial_controls(settings)), digital_gain_(first_gain(settings)) {}

std::vector<Port> NorbitWbms::ports() const {
    // How many hosts a real one takes is not known; one that does not read stalls the others.
    const auto stream = [](const char* name) { return Port{name, Port::Kind::stream, {}, false, 8, true}; };
    return {stream("commands"), stream("bathymetry"), stream("water column")};
}

Actions NorbitWbms::started(Time now) {
    plan_next_ping(now);
    return take_actions();
}

/// Connecting is subscribing. Settings are the sonar's, whoever is connected.
Actions NorbitWbms::connected(std::size_t port, Address peer, Time) {
    if (port == command_port) send(command_port, greeting(settings_), peer);
    if (port == water_column_port) viewers_.insert(peer);
    return take_actions();
}

Actions NorbitWbms::disconnected(std::size_t port, Address peer, Time) {
    if (port == water_column_port) viewers_.erase(peer);
    if (port != command_port) return take_actions();
    if (const auto left = commanders_.extract(peer))
        counters_.skipped_bytes += left.mapped().lines.skipped_bytes();
    return take_actions();
}

Actions NorbitWbms::received(const Received& data, Time now) {
    if (data.port != command_port) {
        counters_.skipped_bytes += data.bytes.size();
        return take_actions();
    }
    Commander& commander = commanders_[data.from];
    commander.lines.feed(data.bytes);
    while (const auto line = commander.lines.next()) obey_line(*line, data.from, now);
    commander.line_ends = commander.lines.waits() ? now + from_seconds(settings_.command_pause) : Time::max();
    return take_actions();
}

/// Who asked is answered.
void NorbitWbms::obey_line(const std::string& line, Address from, Time now) {
    if (line.find_first_not_of(" \t") == std::string::npos) return;
    const auto command = norbit::read_command(line).value_or(norbit::Command{});
    const Reply reply = obey(command, controls_, settings_, now);
    ++(reply.understood ? counters_.messages : counters_.rejected);
    send(command_port, Bytes(reply.text.begin(), reply.text.end()), from);
    actions_.send.back().hang_up = command.name == "exit";
    plan_next_ping(now);
}

bool NorbitWbms::pinging() const {
    constexpr double external_trigger = 4;  // and 5: none ever comes
    return controls_.power != 0 && controls_.trigger_mode < external_trigger;
}

void NorbitWbms::plan_next_ping(Time now) {
    if (!pinging()) return pacer_.pause();
    pacer_.start(now, from_seconds(make_plan(controls_, settings_, digital_gain_).period));
}

double NorbitWbms::time_stamp(Time time) const {
    constexpr double free_run = 8;
    return to_seconds(time) + (controls_.time_source == free_run ? 0 : settings_.unix_start);
}

void NorbitWbms::transmit(Time now) {
    ping_ = {controls_, make_plan(controls_, settings_, digital_gain_), ping_.number + 1, time_stamp(now),
             now};
    actions_.ping = Ping{make_shot(ping_.controls, ping_.plan, settings_, ping_.number),
                         now + from_seconds(ping_.plan.due)};
}

bool NorbitWbms::takes_image() {
    if (viewers_.empty()) return false;
    const double rate = ping_.controls.image_rate;
    const Time interval = rate > 0 ? from_seconds(1 / rate) : Time{};
    const Time sent = pacer_.began().value_or(Time{}), due = last_image_ ? *last_image_ + interval : sent;
    if (sent < due) return false;
    last_image_ = sent < due + interval ? due : sent;  // so that the rate is kept where pings do not fit it
    return true;
}

Actions NorbitWbms::heard(const Echogram& echogram, Time now) {
    const bool expected = pacer_.under_way() && echogram.shot.ping == ping_.number &&
                          echogram.shot.bins == ping_.plan.bins &&
                          echogram.beams() == ping_.plan.bearings.size();
    if (!expected) return take_actions();
    pacer_.end(now, {});
    ++counters_.pings;
    // Of the head's own sensor, where it was when it last measured.
    settings_.sound_speed =
        probe_.of(echogram.sound_speed, settings_.sensors, stray::sound_speed, ping_.since_start);
    if (ping_.controls.mode != 0)
        send(bathymetry_port, bathymetry_packet(ping_, settings_, echogram, time_stamp(now)));
    if (takes_image()) {
        double peak = 0;
        send(water_column_port, water_column_packet(ping_, settings_, echogram, time_stamp(now), peak));
        digital_gain_ = next_gain(controls_, settings_, ping_.plan.digital_gain, peak);
    }
    plan_next_ping(now);
    return take_actions();
}

Actions NorbitWbms::woken(Time now) {
    for (auto& [host, commander] : commanders_) {
        if (now < commander.line_ends) continue;
        commander.line_ends = Time::max();
        obey_line(commander.lines.rest(), host, now);
    }
    if (pacer_.begin(now)) transmit(now);
    return take_actions();
}

DeviceCounters NorbitWbms::counters() const {
    DeviceCounters counters = counters_;
    for (const auto& [host, commander] : commanders_)
        counters.skipped_bytes += commander.lines.skipped_bytes();
    return counters;
}

Actions NorbitWbms::take_actions() {
    Time wake = pacer_.wake();
    for (const auto& [host, commander] : commanders_) wake = std::min(wake, commander.line_ends);
    actions_.wake = wake;
    return std::exchange(actions_, {});
}

}  // namespace echoloop::norbit_device
