#include "emulator/capture/envelope.h"

#include <algorithm>

namespace echoloop {
namespace {

using pcapng::Direction;

constexpr std::size_t ip_header = 20, udp_header = 8, tcp_header = 20, largest_packet = 65535;
constexpr std::uint8_t udp = 17, tcp = 6;
constexpr std::uint8_t syn = 0x02, push = 0x08, ack = 0x10;

/// Big endian.
void put(Bytes& bytes, std::uint32_t value, std::size_t size) {
    for (std::size_t i = size; i-- > 0;) bytes.push_back(static_cast<std::uint8_t>(value >> 8 * i));
}

/// The ones' complement sum of RFC 1071.
std::uint16_t checksum(ByteView bytes) {
    std::uint32_t sum = 0;
    for (std::size_t i = 0; i < bytes.size(); ++i) sum += i % 2 == 0 ? bytes[i] << 8 : bytes[i];
    while (sum > 0xFFFF) sum = (sum & 0xFFFF) + (sum >> 16);
    return static_cast<std::uint16_t>(~sum);
}

Bytes ip_packet(std::uint8_t protocol, const Route& route, std::size_t payload) {
    Bytes bytes;
    bytes.reserve(ip_header + payload);
    put(bytes, 0x4500, 2);
    put(bytes, static_cast<std::uint32_t>(ip_header + payload), 2);
    put(bytes, 0, 2);
    put(bytes, 0x4000, 2);  // don't fragment
    put(bytes, 64, 1);      // hops
    put(bytes, protocol, 1);
    put(bytes, 0, 2);
    put(bytes, route.from.ip, 4);
    put(bytes, route.to.ip, 4);
    const std::uint16_t sum = checksum(bytes);
    bytes[10] = static_cast<std::uint8_t>(sum >> 8);
    bytes[11] = static_cast<std::uint8_t>(sum);
    return bytes;
}

}  // namespace

Bytes rtac_serial_packet(ByteView bytes, pcapng::WallTime time, Direction direction) {
    using namespace std::chrono;
    const auto whole = duration_cast<seconds>(time);
    Bytes packet;
    packet.reserve(12 + bytes.size());
    put(packet, static_cast<std::uint32_t>(whole.count()), 4);
    put(packet, static_cast<std::uint32_t>(duration_cast<microseconds>(time - whole).count()), 4);
    put(packet, direction == Direction::sent ? 1 : 2, 1);
    put(packet, 0, 3);  // modem lines, footer
    packet.insert(packet.end(), bytes.begin(), bytes.end());
    return packet;
}

Bytes udp_packet(ByteView payload, const Route& route) {
    payload = payload.first(std::min(payload.size(), largest_packet - ip_header - udp_header));
    const std::size_t length = udp_header + payload.size();
    Bytes packet = ip_packet(udp, route, length);
    put(packet, route.from.port, 2);
    put(packet, route.to.port, 2);
    put(packet, static_cast<std::uint32_t>(length), 2);
    put(packet, 0, 2);
    packet.insert(packet.end(), payload.begin(), payload.end());
    return packet;
}

TcpConversation::TcpConversation(Address device, Address driver, bool driver_began)
    : device_(device), driver_(driver), driver_began_(driver_began) {}

TcpConversation::Segment TcpConversation::segment(Direction direction, std::uint8_t flags, ByteView payload) {
    const bool sent = direction == Direction::sent;
    std::uint32_t& own = sent ? sent_ : received_;
    const std::uint32_t other = sent ? received_ : sent_;
    Bytes packet =
        ip_packet(tcp, sent ? Route{device_, driver_} : Route{driver_, device_}, tcp_header + payload.size());
    put(packet, (sent ? device_ : driver_).port, 2);
    put(packet, (sent ? driver_ : device_).port, 2);
    put(packet, own, 4);
    put(packet, (flags & ack) != 0 ? other : 0, 4);
    put(packet, tcp_header / 4 << 4, 1);
    put(packet, flags, 1);
    put(packet, 0xFFFF, 2);  // window
    put(packet, 0, 4);       // no checksum, no urgent data
    packet.insert(packet.end(), payload.begin(), payload.end());
    own += static_cast<std::uint32_t>(payload.size());
    return {std::move(packet), direction};
}

std::vector<TcpConversation::Segment> TcpConversation::opening() {
    const Direction first = driver_began_ ? Direction::received : Direction::sent;
    const Direction second = driver_began_ ? Direction::sent : Direction::received;
    sent_ = received_ = 0;
    std::vector<Segment> segments;
    segments.push_back(segment(first, syn, {}));
    (driver_began_ ? received_ : sent_) = 1;
    segments.push_back(segment(second, syn | ack, {}));
    (driver_began_ ? sent_ : received_) = 1;
    segments.push_back(segment(first, ack, {}));
    return segments;
}

std::vector<TcpConversation::Segment> TcpConversation::data(ByteView payload, Direction direction) {
    constexpr std::size_t most = largest_packet - ip_header - tcp_header;
    std::vector<Segment> segments;
    while (!payload.empty()) {
        const ByteView part = payload.first(std::min(payload.size(), most));
        payload = payload.subspan(part.size());
        segments.push_back(segment(direction, push | ack, part));
    }
    return segments;
}

}  // namespace echoloop
