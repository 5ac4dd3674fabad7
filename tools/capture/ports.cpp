#include "tools/capture/ports.h"

#include <algorithm>
#include <map>

namespace echoloop::capture {
namespace {

constexpr std::size_t most_ports = 4096, most_drivers = 4096;  // drivers: of each port

std::string address_text(std::uint32_t ip) {
    std::string text;
    for (int shift = 24; shift >= 0; shift -= 8)
        text += std::to_string(ip >> shift & 0xFF) + (shift > 0 ? "." : "");
    return text;
}

std::string text_of(const Address& end) { return address_text(end.ip) + ":" + std::to_string(end.port); }

}  // namespace

Origin origin_of(const CaptureEvent& event, bool of_ports) {
    const auto* piece = std::get_if<StreamPiece>(&event.content);
    const auto* datagram = std::get_if<Datagram>(&event.content);
    const Address from = piece != nullptr ? piece->from : datagram->from;
    const Address to = piece != nullptr ? piece->to : datagram->to;
    const bool serial = piece != nullptr && from.port == 0 && to.port == 0;
    if (serial) return {{PortKind::serial, piece->line, {}, {}}, piece->sent};
    const PortKind kind = piece != nullptr ? PortKind::tcp : PortKind::udp;
    if (of_ports && event.sent) return {{kind, event.interface, {}, {}}, *event.sent};
    return {{kind, "", std::min(from, to), std::max(from, to)}, from <= to};
}

std::optional<Address> driver_of(const CaptureEvent& event, const PortKey& port) {
    const auto* piece = std::get_if<StreamPiece>(&event.content);
    if (piece == nullptr || port.kind != PortKind::tcp || port.name.empty()) return {};
    return *event.sent ? piece->to : piece->from;
}

ByteView bytes_of(const CaptureEvent& event) {
    if (const auto* piece = std::get_if<StreamPiece>(&event.content)) return piece->bytes;
    return std::get<Datagram>(event.content).payload;
}

bool PortSummary::first_is_device() const {
    const bool known = key.kind == PortKind::serial || !key.name.empty();
    return known || first.bytes >= second.bytes;
}

std::string PortSummary::text() const {
    if (key.kind == PortKind::serial) return key.name.empty() ? "serial line" : key.name;
    if (!key.name.empty()) return key.name;
    return text_of(key.first) + " - " + text_of(key.second) +
           (key.kind == PortKind::tcp ? " (TCP)" : " (UDP)");
}

Survey survey(CaptureReader& capture) {
    Survey result;
    std::map<PortKey, std::size_t> numbers;
    bool begun = false;
    while (const auto event = capture.next()) {
        result.of_ports = capture.of_ports();
        if (!begun) result.begin = event->time;
        begun = true;
        const auto* datagram = std::get_if<Datagram>(&event->content);
        if (datagram != nullptr && datagram->cut) ++result.cut;
        const auto [key, by_first] = origin_of(*event, result.of_ports);
        const auto found = numbers.find(key);
        if (found == numbers.end() && result.ports.size() >= most_ports) {
            ++result.more_ports;
            continue;
        }
        const std::size_t number = found == numbers.end() ? result.ports.size() : found->second;
        if (found == numbers.end()) {
            numbers.emplace(key, number);
            result.ports.push_back({key, {}, {}, event->time, event->time, {}});
        }
        PortSummary& port = result.ports[number];
        SideCounts& side = by_first ? port.first : port.second;
        ++side.pieces;
        side.bytes += bytes_of(*event).size();
        port.end = event->time;
        const auto driver = driver_of(*event, key);
        if (driver && (port.drivers.contains(*driver) || port.drivers.size() < most_drivers))
            port.drivers[*driver] = event->time;
    }
    result.counts = capture.counts();
    return result;
}

bool PortFilter::fits_end(const Address& end) const {
    if (text_ == text_of(end) || text_ == address_text(end.ip)) return true;
    return text_ == std::to_string(end.port);
}

bool PortFilter::fits(const PortKey& port) const {
    return text_ == PortSummary{port, {}, {}, 0, 0, {}}.text() || port.name.starts_with(text_ + ' ') ||
           end_is_first(port).has_value();
}

std::optional<bool> PortFilter::end_is_first(const PortKey& port) const {
    if (port.kind == PortKind::serial || !port.name.empty()) return {};
    if (text_ == PortSummary{port, {}, {}, 0, 0, {}}.text()) return {};
    if (fits_end(port.first)) return true;
    if (fits_end(port.second)) return false;
    return {};
}

}  // namespace echoloop::capture
