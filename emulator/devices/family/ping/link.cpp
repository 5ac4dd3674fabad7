#include "emulator/devices/family/ping/link.h"

#include <algorithm>
#include <cstdio>
#include <stdexcept>
#include <utility>

namespace echoloop::ping_device {
namespace {

constexpr std::uint8_t mark = 0x55;
constexpr std::size_t most_endpoints = 4;

}  // namespace

std::array<std::uint8_t, 3> read_version(const std::string& text, const std::string& option) {
    unsigned a = 256, b = 256, c = 256;
    char more = 0;
    const int found = std::sscanf(text.c_str(), "%3u.%3u.%3u%c", &a, &b, &c, &more);
    if (found != 3 || a > 255 || b > 255 || c > 255)
        throw std::invalid_argument("option '" + option + "': '" + text +
                                    "' is no version; write three numbers of 0 to 255 like 3.3.8");
    return {static_cast<std::uint8_t>(a), static_cast<std::uint8_t>(b), static_cast<std::uint8_t>(c)};
}

Link::Link(std::uint8_t id, bool marks_are_breaks)
    : hosts_(ping::Framer(ping::Framer::Waiting::impatient)), id_(id), marks_are_breaks_(marks_are_breaks) {}

Heard Link::receive(const Received& data) {
    Heard heard;
    ping::Framer& framer = hosts_.of({data.port, data.from});
    heard.line_break =
        marks_are_breaks_ && framer.pending_bytes() == 0 && !data.bytes.empty() && data.bytes.front() == mark;
    framer.feed(data.bytes);
    while (auto frame = framer.next()) heard.frames.push_back(*std::move(frame));
    return heard;
}

Send Link::reply_without_content(ping::Id id, const Peer& to) const {
    ping::Frame frame = ping::short_request(id);
    frame.header.source = id_;
    frame.checksum = ping::checksum(ping::encode(frame));
    return {to.port, ping::encode(frame), to.address, {}};
}

std::vector<Send> in_pieces(wire::Bytes frame, const Peer& to, std::size_t piece) {
    std::vector<Send> sends;
    if (piece == 0 || frame.size() <= piece) {
        sends.push_back({to.port, std::move(frame), to.address, {}});
        return sends;
    }
    for (auto left = wire::ByteView(frame); !left.empty(); left = left.subspan(sends.back().bytes.size())) {
        const auto next = left.first(std::min(piece, left.size()));
        sends.push_back({to.port, {next.begin(), next.end()}, to.address, {}});
    }
    return sends;
}

std::vector<Port> link_ports(const std::vector<Endpoint>& endpoints, double baud) {
    if (endpoints.empty() || endpoints.size() > most_endpoints)
        throw std::invalid_argument("give one to four endpoints: each is another way to the same device");
    std::vector<Port> ports;
    for (const Endpoint& endpoint : endpoints) {
        if (endpoint.on_udp() && baud > 0)
            throw std::invalid_argument("a line rate would cut the datagrams of " + to_string(endpoint) +
                                        ": set baud to 0, or leave that endpoint out");
        ports.push_back({"line " + std::to_string(ports.size() + 1), Port::Kind::stream, {}, false});
    }
    return ports;
}

ping::Nack nack(ping::Id refused, std::string_view text) {
    ping::Nack message{static_cast<std::uint16_t>(refused), {text.begin(), text.end()}};
    message.text.push_back(0);
    return message;
}

void version(std::array<std::uint8_t, 3>& member, OptionList& options, std::string_view name,
             std::string_view help, std::string_view source) {
    std::string text =
        std::to_string(member[0]) + "." + std::to_string(member[1]) + "." + std::to_string(member[2]);
    options.text(text, name, help, source);
    member = read_version(text, std::string(name));
}

}  // namespace echoloop::ping_device
