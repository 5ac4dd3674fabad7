#include "emulator/contract/network.h"

#include <arpa/inet.h>

#include <charconv>
#include <stdexcept>

namespace echoloop {

Network parse_network(std::string_view text) {
    const auto slash = text.find('/');
    const std::string ip(text.substr(0, std::min<std::size_t>(slash, 40)));
    const std::string_view prefix = slash == text.npos ? "32" : text.substr(slash + 1);
    in_addr address{};
    int bits = -1;
    const auto [end, error] = std::from_chars(prefix.data(), prefix.data() + prefix.size(), bits);
    const bool whole = error == std::errc{} && end == prefix.data() + prefix.size();
    if (::inet_pton(AF_INET, ip.c_str(), &address) != 1 || !whole || bits < 0 || bits > 32)
        throw std::invalid_argument("no network of IPv4; write it as in 192.168.2.0/24 or 192.168.2.10");
    return {ntohl(address.s_addr) & Network::mask(bits), bits};
}

std::string to_string(const Network& network) {
    char text[INET_ADDRSTRLEN];
    const in_addr address{htonl(network.ip)};
    ::inet_ntop(AF_INET, &address, text, sizeof text);
    return std::string(text) + "/" + std::to_string(network.bits);
}

}  // namespace echoloop
