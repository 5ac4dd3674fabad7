#include "emulator/devices/family/talker/wiring.h"

#include <cstdint>
#include <stdexcept>
#include <utility>

namespace echoloop::talker {
namespace {

Wiring wiring_of(const Endpoint& e, const std::string& number, std::size_t most) {
    constexpr std::uint32_t loopback = 0x7F000001;
    constexpr std::size_t programs = 8;
    if (e.scheme == Endpoint::Scheme::udp_listen)
        throw std::invalid_argument(
            to_string(e) + ": it speaks first; name the host that is to hear it, udp://ADDRESS:PORT");
    const Address host = e.scheme == Endpoint::Scheme::udp ? Address{e.ip, e.port} : Address{};
    if (host.port != 0 && number.empty()) {
        const Address from{is_loopback(e.ip) ? loopback : 0, e.local_port()};
        return {{"datagrams", Port::Kind::datagram, from, false}, host};
    }
    Port line{"line" + number, Port::Kind::stream, {}, false};
    if (most > 1 && e.scheme == Endpoint::Scheme::tcp_listen) line.drivers = programs;
    return {std::move(line), host};
}

}  // namespace

std::vector<Wiring> read_wiring(const std::vector<Endpoint>& endpoints, const std::string& model,
                                std::size_t most) {
    if (endpoints.empty() || endpoints.size() > most)
        throw std::invalid_argument(most == 1 ? "a " + model + " has one port: give exactly one endpoint"
                                              : "a " + model + " serves one to " + std::to_string(most) +
                                                    " endpoints");
    std::vector<Wiring> all;
    for (const Endpoint& e : endpoints)
        all.push_back(wiring_of(e, endpoints.size() == 1 ? "" : ' ' + std::to_string(all.size() + 1), most));
    return all;
}

}  // namespace echoloop::talker
