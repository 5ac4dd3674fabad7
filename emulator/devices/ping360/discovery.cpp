#include "emulator/devices/ping360/discovery.h"

#include <cstdio>

namespace echoloop::ping360 {
namespace {

constexpr std::uint32_t loopback_broadcast = 0x7FFFFFFF;  // 127.255.255.255

/// Four lines, as hosts take them apart: octets of three digits, the address of the hardware in capitals.
std::string reply(std::uint32_t address) {
    char padded[16];
    std::snprintf(padded, sizeof padded, "%03u.%03u.%03u.%03u", address >> 24, address >> 16 & 255,
                  address >> 8 & 255, address & 255);
    return std::string(
               "SONAR PING360  \r\nBlue Robotics\r\nMAC Address:- 54-10-EC-00-00-01\r\nIP Address:- ") +
           padded + "\r\n";
}

}  // namespace

std::optional<std::uint32_t> read_address(std::string_view text) {
    const std::string terminated(text);
    unsigned o[4]{};
    char more = 0;
    if (std::sscanf(terminated.c_str(), "%3u.%3u.%3u.%3u%c", &o[0], &o[1], &o[2], &o[3], &more) != 4)
        return std::nullopt;
    for (unsigned octet : o)
        if (octet > 255) return std::nullopt;
    return o[0] << 24 | o[1] << 16 | o[2] << 8 | o[3];
}

std::vector<Port> Discovery::ports() const {
    constexpr auto datagram = Port::Kind::datagram;
    if (own_ == 0) return {};
    if (!is_loopback(own_)) return {{"discovery", datagram, {0, discovery_port}, true}};
    return {{"discovery", datagram, {own_, discovery_port}, true},
            {"discovery broadcast", datagram, {loopback_broadcast, discovery_port}, true}};
}

std::optional<std::string> Discovery::hear(std::string_view text) {
    constexpr std::string_view set = "SetSS1IP ";
    while (!text.empty() && (text.back() == '\r' || text.back() == '\n' || text.back() == '\0'))
        text.remove_suffix(1);
    if (text == "Discovery") return reply(told_);
    if (text.starts_with(set))
        if (const auto address = read_address(text.substr(set.size())))
            told_ = *address == 0 ? own_ : *address;
    return std::nullopt;
}

}  // namespace echoloop::ping360
