#include "emulator/transport/peers.h"

#include <ifaddrs.h>
#include <netinet/in.h>

#include <algorithm>
#include <bit>
#include <memory>

#include "emulator/contract/device.h"

namespace echoloop {
namespace {

std::uint32_t ip_of(const sockaddr* address) {
    return ntohl(reinterpret_cast<const sockaddr_in*>(address)->sin_addr.s_addr);
}

/// An address of this machine, and its network.
struct Own {
    std::uint32_t ip;
    Network network;
};

std::vector<Own> own_addresses() {
    ifaddrs* found = nullptr;
    if (::getifaddrs(&found) != 0) return {};
    const std::unique_ptr<ifaddrs, decltype(&::freeifaddrs)> list(found, ::freeifaddrs);
    std::vector<Own> all;
    for (const ifaddrs* one = list.get(); one != nullptr; one = one->ifa_next) {
        const bool whole = one->ifa_addr != nullptr && one->ifa_netmask != nullptr;
        if (!whole || one->ifa_addr->sa_family != AF_INET) continue;
        const std::uint32_t ip = ip_of(one->ifa_addr);
        const int bits = std::popcount(ip_of(one->ifa_netmask));
        all.push_back({ip, {ip & Network::mask(bits), bits}});
    }
    return all;
}

}  // namespace

Peers::Peers(std::uint32_t bound, std::span<const Network> named, std::span<const std::uint32_t> destinations)
    : on_loopback_(is_loopback(bound)) {
    constexpr Network loopback{0x7F000000, 8};
    if (on_loopback_) {
        networks_ = {loopback};
        return;
    }
    networks_.assign(named.begin(), named.end());
    for (const Own& own : own_addresses()) {
        own_.push_back(own.ip);
        const bool asked = named.empty() && (bound == 0 || own.ip == bound);
        if (asked && std::ranges::find(networks_, own.network) == networks_.end())
            networks_.push_back(own.network);
    }
    for (const std::uint32_t ip : destinations)
        if (!holds(ip)) networks_.push_back({ip, 32});
}

bool Peers::holds(std::uint32_t ip) const {
    if (is_loopback(ip) || std::ranges::find(own_, ip) != own_.end()) return true;
    return std::ranges::any_of(networks_, [ip](const Network& network) { return network.holds(ip); });
}

std::string Peers::describe() const {
    if (on_loopback_) return "";
    std::string text;
    for (const Network& network : networks_) text += (text.empty() ? "" : ", ") + to_string(network);
    return text.empty() ? "nobody" : text;
}

}  // namespace echoloop
