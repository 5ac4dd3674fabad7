#include "emulator/devices/family/cerulean/sonar.h"

namespace echoloop::cerulean_device {

Sonar::Sonar(const Identity& identity, const Sensors& sensors, std::vector<Endpoint> endpoints)
    : identity_(identity),
      sensors_(sensors),
      endpoints_(std::move(endpoints)),
      ports_(make_ports(endpoints_, identity_)),
      pieces_(pieces(endpoints_, identity_)),
      link_(identity_.source, true) {}

Actions Sonar::received(const Received& data, Time now) {
    now_ = now;
    if (data.port >= pieces_.size()) {
        discover(data);
        return take_actions();
    }
    for (const ping::Frame& frame : link_.receive(data).frames) obey(frame, {data.port, data.from}, now);
    return take_actions();
}

Actions Sonar::heard(const Echogram& echogram, Time now) {
    now_ = now;
    if (echogram.shot.ping != pings_ || !pacer_.under_way()) return take_actions();
    ++counters_.pings;
    report(echogram);
    pacer_.end(now + identity_.line.time(actions_.send), interval());
    return take_actions();
}

Actions Sonar::woken(Time now) {
    if (pacer_.begin(now)) transmit(now);
    return take_actions();
}

DeviceCounters Sonar::counters() const {
    DeviceCounters counters = counters_;
    counters.skipped_bytes = link_.skipped_bytes();
    return counters;
}

void Sonar::discover(const Received& data) {
    auto words = discovery_reply(data.bytes, endpoints_, identity_);
    if (words.empty()) return;
    ++counters_.messages;
    actions_.send.push_back({data.port, std::move(words), data.from, {}});
}

void Sonar::on(const ping::GeneralRequest& request, const Peer& peer, Time) {
    const auto requested = static_cast<ping::Id>(request.requested_id);
    if (!send_message(requested, peer)) refuse(refused_id(identity_, requested), unknown_command, peer);
}

void Sonar::set_speed_of_sound(std::uint32_t wanted, cerulean::Id id, const Peer& peer,
                               std::uint32_t& speed) {
    if (!is_speed_of_sound(wanted))
        return refuse(static_cast<ping::Id>(id), "speed of sound out of range", peer);
    speed = wanted;
    acknowledge(id, peer);
}

bool Sonar::send_message(ping::Id id, const Peer& peer) {
    if (id == ping::Id::device_information)
        reply(ping::Message(device_information(identity_)), peer);
    else if (id == ping::Id::protocol_version)
        reply(ping::Message(protocol_version(identity_)), peer);
    else
        return send_own(id, peer);
    return true;
}

void Sonar::acknowledge(cerulean::Id id, const Peer& peer) {
    if (identity_.acknowledge) reply(ping::Message(ping::Ack{static_cast<std::uint16_t>(id)}), peer);
}

void Sonar::refuse(ping::Id id, std::string_view text, const Peer& peer) {
    ++counters_.rejected;
    reply(ping::Message(ping_device::nack(id, text)), peer);
}

void Sonar::start_pings(const Peer& listener, Time now) {
    listener_ = listener;
    pacer_.start(now, interval());
}

std::uint32_t Sonar::pinged_at() const {
    return static_cast<std::uint32_t>(
        std::chrono::duration_cast<std::chrono::milliseconds>(pinged_at_).count());
}

void Sonar::transmit(Time now) {
    pinged_at_ = now;
    Shot shot = next_shot();
    shot.ping = ++pings_;
    actions_.ping = Ping{std::move(shot), now + from_seconds(ping_time())};
}

void Sonar::line_rate(std::size_t port, double rate) { identity_.line.follow(port, rate); }

Actions Sonar::take_actions() {
    actions_.wake = pacer_.wake();
    return std::exchange(actions_, {});
}

}  // namespace echoloop::cerulean_device
