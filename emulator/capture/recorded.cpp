#include "emulator/capture/recorded.h"

namespace echoloop {

using pcapng::Direction;

Recorded::Recorded(std::unique_ptr<Transport> transport, Recording& recording, const std::string& name, Side side)
    : Decorator(std::move(transport)),
      recording_(recording),
      side_(side),
      kind_(line().wire().kind),
      interface_(recording.add_interface(
          kind_ == Wire::Kind::serial ? pcapng::LinkType::rtac_serial : pcapng::LinkType::raw_ip, name,
          line().describe())) {}

void Recorded::start(Events events) {
    Events ours = events;
    ours.received = [this, received = std::move(events.received)](ByteView bytes, Address from) {
        record(bytes, false, from);
        received(bytes, from);
    };
    ours.reconnected = [this, reconnected = std::move(events.reconnected)] {
        begin_conversation();
        reconnected();
    };
    line().start(std::move(ours));
}

void Recorded::annotate(const std::string& remark) {
    constexpr std::size_t most = 4096;  // of a packet with very many faults
    if (remarks_.size() < most) remarks_ += (remarks_.empty() ? "" : "\n") + remark;
}

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
    if (gone > 0) record(bytes.first(std::min<std::size_t>(bytes.size(), gone)), true, to);
}

/// `ours`: written by the user of this transport.
void Recorded::record(ByteView bytes, bool ours, Address other) {
    const auto time = recording_.now();
    const auto direction = ours == (side_ == Side::device) ? Direction::sent : Direction::received;
    if (kind_ == Wire::Kind::serial) {
        add(time, direction, rtac_serial_packet(bytes, time, direction));
    } else if (kind_ == Wire::Kind::udp) {
        const Wire wire = line().wire();
        if (other.port == 0) other = wire.remote;
        add(time, direction, udp_packet(bytes, ours ? Route{wire.local, other} : Route{other, wire.local}));
    } else if (conversation_) {
        for (const auto& segment : conversation_->data(bytes, direction))
            add(time, direction, segment.packet);
    }
}

void Recorded::add(pcapng::WallTime time, Direction direction, ByteView packet) {
    std::string comment;
    if (direction == Direction::sent) comment.swap(remarks_);
    recording_.add({interface_, time, direction, std::move(comment)}, packet);
}

}  // namespace echoloop
