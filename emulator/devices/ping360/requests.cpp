// What a Ping360 says when it is asked: who it is, and what its last ping was.
#include "emulator/devices/ping360/ping360.h"

namespace echoloop::ping360 {

using ping::Id;

void Ping360::obey(const ping::Frame& frame, const Peer& peer, Time now) {
    const Id id = frame.header.id;
    if (ping::is_short_request(frame) && send_message(id, peer, now)) {
        ++counters_.messages;
        return;
    }
    const auto message = ping::parse(frame);
    if (!message) {
        refuse(id, unknown_command, peer, now);
        return;
    }
    std::visit(
        [&](const auto& m) {
            if constexpr (requires { on(m, peer, now); }) {
                ++counters_.messages;
                on(m, peer, now);
            } else if constexpr (std::is_same_v<std::decay_t<decltype(m)>, ping::Ack> ||
                                 std::is_same_v<std::decay_t<decltype(m)>, ping::Nack>) {
                ++counters_.rejected;  // never answered, else two devices on one line would not end
            } else {
                refuse(id, unknown_command, peer, now);
            }
        },
        *message);
}

void Ping360::on(const ping::GeneralRequest& request, const Peer& peer, Time now) {
    const auto requested = static_cast<Id>(request.requested_id);
    if (send_message(requested, peer, now)) return;
    refuse(settings_.nack_requested_id ? requested : Id::general_request, unknown_command, peer, now);
}

/// False if there is no such message.
bool Ping360::send_message(Id id, const Peer& peer, Time now) {
    const auto& f = settings_.firmware;
    const auto& p = settings_.protocol;
    if (id == Id::device_information) {
        reply(ping::DeviceInformation{settings_.device_type, settings_.device_revision, f[0], f[1], f[2], 0},
              peer, now);
    } else if (id == Id::protocol_version) {
        reply(ping::ProtocolVersion{p[0], p[1], p[2], 0}, peer, now);
    } else if (id == Id::device_data) {
        reply(last_on_request(), peer, now);
    } else if (id == Id::auto_device_data && settings_.scans_by_itself()) {
        reply(automatic(last_on_request(), last_scan_), peer, now);
    } else {
        return false;
    }
    return true;
}

ping::DeviceData Ping360::last_on_request() const {
    ping::DeviceData data = last_;
    if (!settings_.last_data_on_request) data.data.clear();
    return data;
}

void Ping360::on(const ping::Ping360SetDeviceId& command, const Peer& peer, Time now) {
    if (command.id == 0 || command.id == 255) {
        refuse(Id::ping360_set_device_id, "id out of range", peer, now);
        return;
    }
    link_.set_id(command.id);
    if (settings_.ack_set_id)
        reply(ping::Ack{static_cast<std::uint16_t>(Id::ping360_set_device_id)}, peer, now);
}

void Ping360::on(const ping::SetDeviceId& command, const Peer& peer, Time now) {
    if (!settings_.accept_common_id || command.device_id == 0 || command.device_id == 255) {
        refuse(Id::set_device_id, unknown_command, peer, now);
        return;
    }
    link_.set_id(command.device_id);
    reply(ping::Ack{static_cast<std::uint16_t>(Id::set_device_id)}, peer, now);
}

void Ping360::hear_discovery(const Received& data, Time now) {
    const std::string_view text(reinterpret_cast<const char*>(data.bytes.data()), data.bytes.size());
    if (const auto words = discovery_.hear(text)) {
        actions_.send.push_back({data.port, {words->begin(), words->end()}, data.from, now});
        ++counters_.messages;
    }
}

}  // namespace echoloop::ping360
