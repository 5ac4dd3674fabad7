#include "emulator/contract/network.h"

#include <charconv>
#include <stdexcept>

namespace echoloop {

std::optional<std::uint32_t> decimal(std::string_view text, std::uint32_t maximum) {
    std::uint32_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (text.empty() || error != std::errc{} || end != text.data() + text.size() || value > maximum)
        return {};
    return value;
}

std::optional<std::uint32_t> parse_ipv4(std::string_view text) {
    std::uint32_t ip = 0;
    for (int octet = 0; octet < 4; ++octet) {
        const auto dot = octet < 3 ? text.find('.') : text.size();
        if (dot == std::string_view::npos || dot > 3) return {};
        const auto value = decimal(text.substr(0, dot), 255);
        if (!value) return {};
        ip = ip << 8 | *value;
        text.remove_prefix(octet < 3 ? dot + 1 : dot);
    }
    return ip;
}

std::string ipv4_text(std::uint32_t ip) {
    std::string text;
    for (int shift = 24; shift >= 0; shift -= 8)
        text += std::to_string(ip >> shift & 0xFF) + (shift > 0 ? "." : "");
    return text;
}

Network parse_network(std::string_view text) {
    const auto slash = text.find('/');
    const auto ip = parse_ipv4(text.substr(0, slash));
    const auto bits = slash == text.npos ? 32 : decimal(text.substr(slash + 1), 32);
    if (!ip || !bits)
        throw std::invalid_argument("no network of IPv4; write it as in 192.168.2.0/24 or 192.168.2.10");
    const int prefix = static_cast<int>(*bits);
    return {*ip & Network::mask(prefix), prefix};
}

std::string to_string(const Network& network) {
    return ipv4_text(network.ip) + "/" + std::to_string(network.bits);
}

}  // namespace echoloop
