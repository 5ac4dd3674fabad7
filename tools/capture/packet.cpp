#include "tools/capture/packet.h"

#include <pcap/dlt.h>

#include <algorithm>

namespace echoloop::capture {
namespace {

constexpr std::size_t most_partials = 64;
constexpr std::size_t most_pieces = 1024;
constexpr std::size_t udp_header = 8;
constexpr std::size_t smallest_ipv4_header = 20;
constexpr std::uint8_t udp_protocol = 17, tcp_protocol = 6;
constexpr int linktype_raw = 101, rtac_serial = 250;  // numbers in files, where a DLT_ may differ
constexpr std::uint16_t ipv4_type = 0x0800;

/// Big-endian; the caller has checked that the bytes are there.
std::uint16_t u16(ByteView bytes, std::size_t at) {
    return static_cast<std::uint16_t>(bytes[at] << 8 | bytes[at + 1]);
}
std::uint32_t u32(ByteView bytes, std::size_t at) {
    return static_cast<std::uint32_t>(u16(bytes, at)) << 16 | u16(bytes, at + 2);
}

/// What lies behind a header of `size` bytes whose ethertype is at `type_at`; VLAN tags are passed over.
std::optional<ByteView> behind_ethertype(ByteView packet, std::size_t type_at, std::size_t size) {
    constexpr std::size_t tag = 4;
    for (int tags = 0; tags < 3 && packet.size() >= size; ++tags) {
        const auto type = u16(packet, type_at);
        if (type == ipv4_type) return packet.subspan(size);
        if (type != 0x8100 && type != 0x88A8) return {};
        type_at = size + 2;
        size += tag;
        if (packet.size() < size) return {};
    }
    return {};
}

/// BSD loopback: the address family in 4 bytes of either order, AF_INET = 2.
std::optional<ByteView> behind_null(ByteView packet) {
    if (packet.size() < 4) return {};
    const auto family = u32(packet, 0);
    if (family != 2 && family != 0x02000000) return {};
    return packet.subspan(4);
}

std::optional<ByteView> ip_packet(int link_type, ByteView packet) {
    switch (link_type) {
        case DLT_EN10MB:
            return behind_ethertype(packet, 12, 14);
        case DLT_LINUX_SLL:
            return behind_ethertype(packet, 14, 16);
        case DLT_LINUX_SLL2:
            return behind_ethertype(packet, 0, 20);
        case DLT_NULL:
        case DLT_LOOP:
            return behind_null(packet);
        case DLT_RAW:
        case linktype_raw:
        case DLT_IPV4:
            return packet;
        default:
            return {};
    }
}

std::optional<Datagram> datagram_of(Address from, Address to, Bytes udp) {
    if (udp.size() < udp_header) return {};
    const std::size_t claimed = u16(udp, 4);
    if (claimed < udp_header) return {};
    Datagram datagram{from, to, {}, claimed > udp.size()};
    datagram.from.port = u16(udp, 0);
    datagram.to.port = u16(udp, 2);
    const auto end = udp.begin() + static_cast<std::ptrdiff_t>(std::min(claimed, udp.size()));
    datagram.payload.assign(udp.begin() + udp_header, end);
    return datagram;
}

std::optional<TcpSegment> segment_of(Address from, Address to, ByteView tcp) {
    constexpr std::size_t smallest_header = 20;
    constexpr std::uint8_t syn = 2;
    if (tcp.size() < smallest_header) return {};
    const std::size_t header = (tcp[12] >> 4) * std::size_t{4};
    if (header < smallest_header || header > tcp.size()) return {};
    TcpSegment segment{from, to, u32(tcp, 4), (tcp[13] & syn) != 0, {}};
    segment.from.port = u16(tcp, 0);
    segment.to.port = u16(tcp, 2);
    const ByteView payload = tcp.subspan(header);
    segment.payload.assign(payload.begin(), payload.end());
    return segment;
}

/// Twelve bytes of time, event and modem lines; data of the capturing side or of the other.
std::optional<SerialBytes> serial_of(ByteView packet) {
    constexpr std::size_t header = 12;
    constexpr std::uint8_t sent = 1, received = 2, last = 4;
    if (packet.size() < header || packet[8] < sent || packet[8] > last) return {};
    const ByteView payload = packet.subspan(header);
    return SerialBytes{packet[8] % received == sent, {payload.begin(), payload.end()}};
}

}  // namespace

bool PacketReader::reads(int link_type) {
    constexpr int known[] = {DLT_EN10MB, DLT_LINUX_SLL, DLT_LINUX_SLL2, DLT_NULL,   DLT_LOOP,
                             DLT_RAW,    DLT_IPV4,      linktype_raw,   rtac_serial};
    return std::ranges::find(known, link_type) != std::end(known);
}

Packet PacketReader::skip() {
    ++skipped_;
    return {};
}

Packet PacketReader::read(int link_type, ByteView packet) {
    ++clock_;
    if (link_type == rtac_serial) {
        auto bytes = serial_of(packet);
        return bytes ? Packet(std::move(*bytes)) : skip();
    }
    const auto ip = ip_packet(link_type, packet);
    return ip ? read_ipv4(*ip) : skip();
}

Packet PacketReader::read_ipv4(ByteView packet) {
    if (packet.size() < smallest_ipv4_header || packet[0] >> 4 != 4) return skip();
    const std::size_t header = (packet[0] & 0xF) * std::size_t{4};
    const std::size_t length = u16(packet, 2);
    const bool tcp = packet[9] == tcp_protocol;
    if (header < smallest_ipv4_header || length < header || packet.size() < header ||
        (packet[9] != udp_protocol && !tcp))
        return skip();
    const auto body = packet.subspan(header, std::min(length, packet.size()) - header);
    const std::size_t at = (u16(packet, 6) & 0x1FFF) * std::size_t{8};
    const bool more = (u16(packet, 6) & 0x2000) != 0;
    const Address from{u32(packet, 12), 0};
    const Address to{u32(packet, 16), 0};
    if (tcp) {
        auto segment = at == 0 && !more ? segment_of(from, to, body) : std::nullopt;
        return segment ? Packet(std::move(*segment)) : skip();
    }
    std::optional<Bytes> whole;
    if (at == 0 && !more) {
        whole.emplace(body.begin(), body.end());
    } else {
        whole = assemble({from.ip, to.ip, u16(packet, 4)}, body, at, more);
        if (!whole) return {};
    }
    auto datagram = datagram_of(from, to, std::move(*whole));
    return datagram ? Packet(std::move(*datagram)) : skip();
}

std::optional<Bytes> PacketReader::assemble(const Key& key, ByteView piece, std::size_t at, bool more) {
    constexpr std::size_t largest = 65535;
    if (piece.empty() || at + piece.size() > largest) return {};
    if (!partials_.contains(key) && partials_.size() >= most_partials) forget_oldest();
    Partial& partial = partials_[key];
    partial.age = clock_;
    if (partial.pieces.size() >= most_pieces) return {};
    const std::size_t end = at + piece.size();
    if (!more) partial.total = end;
    partial.bytes.resize(std::max(partial.bytes.size(), end));
    std::ranges::copy(piece, partial.bytes.begin() + static_cast<std::ptrdiff_t>(at));
    partial.pieces[at] = std::max(partial.pieces[at], end);
    std::size_t covered = 0;
    for (const auto& [first, last] : partial.pieces)
        if (first <= covered) covered = std::max(covered, last);
    if (!partial.total || covered < *partial.total) return {};
    Bytes whole = std::move(partial.bytes);
    whole.resize(*partial.total);
    partials_.erase(key);
    return whole;
}

void PacketReader::forget_oldest() {
    partials_.erase(
        std::ranges::min_element(partials_, {}, [](const auto& entry) { return entry.second.age; }));
    ++skipped_;
}

}  // namespace echoloop::capture
