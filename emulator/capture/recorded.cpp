#include "emulator/capture/recorded.h"

namespace echoloop {

using pcapng::Direction;
namespace {

void append(std::string& remarks, const std::string& remark) {
    constexpr std::size_t most = 4096;  // of a packet with very many faults
    if (remarks.size() < most) remarks += (remarks.empty() ? "" : "\n") + remark;
}

}  // namespace

std::uint32_t Recorded::add_interface(Recording& recording, const Transport& transport,
                                      const std::string& name) {
    const bool serial = transport.wire().kind == Wire::Kind::serial;
    return recording.add_interface(serial ? pcapng::LinkType::rtac_serial : pcapng::LinkType::raw_ip, name,
                                   transport.describe());
}

Recorded::Recorded(std::unique_ptr<Transport> transport, Recording& recording, std::uint32_t interface,
                   Side side)
    : Decorator(std::move(transport)),
      recording_(recording),
      side_(side),
      kind_(line().wire().kind),
      interface_(interface) {}

void Recorded::start(Events events) {
    Events ours = events;
    ours.received = [this, received = std::move(events.received)](ByteView bytes, Address from) {
        const auto time = recording_.now();
        received(bytes, from);  // first: it may have remarks
        record(bytes, false, from, time);
    };
    ours.reconnected = [this, reconnected = std::move(events.reconnected)] {
        begin_conversation();
        reconnected();
    };
    // The driver of a free run was there from the start, and no connection of its own is told of.
    ours.connected = [this, connected = std::move(events.connected)](Address peer) {
        if (!conversation_) begin_conversation();
        connected(peer);
    };
    line().start(std::move(ours));
}

void Recorded::annotate(const std::string& remark) { append(remarks_, remark); }

void Recorded::annotate_received(const std::string& remark) { append(remarks_on_received_, remark); }

void Recorded::begin_conversation() {
    const Wire wire = line().wire();
    if (kind_ != Wire::Kind::tcp_server && kind_ != Wire::Kind::tcp_client) return;
    const bool served = kind_ == Wire::Kind::tcp_server, device = side_ == Side::device;
    conversation_.emplace(device ? wire.local : wire.remote, device ? wire.remote : wire.local,
                          served == device);
    for (const auto& segment : conversation_->opening())
        add(recording_.now(), segment.direction, segment.packet);
}

Task<void> Recorded::write(ByteView bytes, Address to) {
    const std::uint64_t before = line().bytes_out();
    co_await line().write(bytes, to);
    const std::uint64_t gone = line().bytes_out() - before;
    if (gone > 0) record(bytes.first(std::min<std::size_t>(bytes.size(), gone)), true, to, recording_.now());
}

/// `ours`: written by the user of this transport.
void Recorded::record(ByteView bytes, bool ours, Address other, pcapng::WallTime time) {
    std::string* const remarks = ours ? &remarks_ : &remarks_on_received_;
    const auto direction = ours == (side_ == Side::device) ? Direction::sent : Direction::received;
    if (kind_ == Wire::Kind::serial) {
        add(time, direction, rtac_serial_packet(bytes, time, direction), remarks);
    } else if (kind_ == Wire::Kind::udp) {
        const Wire wire = line().wire();
        if (other.port == 0) other = wire.remote;
        add(time, direction, udp_packet(bytes, ours ? Route{wire.local, other} : Route{other, wire.local}),
            remarks);
    } else if (conversation_) {
        for (const auto& segment : conversation_->data(bytes, direction))
            add(time, direction, segment.packet, remarks);
    }
}

/// The first packet takes the remarks along.
void Recorded::add(pcapng::WallTime time, Direction direction, ByteView packet, std::string* remarks) {
    std::string comment;
    if (remarks != nullptr) comment.swap(*remarks);
    recording_.add({interface_, time, direction, std::move(comment)}, packet);
}

std::unique_ptr<Transport> PortRecorder::operator()(std::unique_ptr<Transport> wire, const Port& port) {
    auto found = interfaces_.find(port.name);
    if (found == interfaces_.end()) {
        const auto added = Recorded::add_interface(*recording_, *wire, device_ + " " + port.name);
        found = interfaces_.emplace(port.name, added).first;
    }
    return std::make_unique<Recorded>(std::move(wire), *recording_, found->second);
}

}  // namespace echoloop
