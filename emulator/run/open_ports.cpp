#include "emulator/run/open_ports.h"

#include <boost/asio/ip/address_v4.hpp>

#include "emulator/clock/stepped_clock.h"
#include "emulator/contract/error.h"
#include "emulator/transport/free_ports.h"

namespace echoloop {
namespace {

PortPlace place_of(const Port& port, const Transport& transport, const std::vector<Endpoint>& endpoints,
                   std::size_t& next_stream) {
    if (port.kind == Port::Kind::stream) return {port.name, endpoint_of(port, endpoints, next_stream)};
    const Address own = transport.wire().local;
    Endpoint place;
    place.scheme = Endpoint::Scheme::udp_listen;
    place.ip = own.ip;
    place.host = asio::ip::address_v4(own.ip).to_string();
    place.port = own.port;
    return {port.name, place};
}

}  // namespace

OpenPorts open_ports(Clock& clock, const ScenarioDevice& device, Drivers drivers, const Around& around) {
    constexpr unsigned most_attempts = 32;
    const bool free = drivers == Drivers::scripted;
    const bool stepped = dynamic_cast<SteppedClock*>(&clock) != nullptr;
    DeviceConfig config = device.config;
    for (unsigned attempt = 1;; ++attempt) {
        config.endpoints = with_numbers(device.config.endpoints, stepped ? device.name : "", attempt);
        const auto ports = device.model->make(config)->ports();
        try {
            OpenPorts open{config.endpoints,
                           free ? make_scripted_transports(clock, ports, config, device.script, around)
                                : make_transports(clock, ports, config, around),
                           {}};
            std::size_t next_stream = 0;
            for (std::size_t i = 0; i < ports.size(); ++i)
                open.places.push_back(place_of(ports[i], *open.transports[i], open.endpoints, next_stream));
            return open;
        } catch (const StartError& error) {
            const bool taken = error.exit() == Exit::unavailable && has_open_number(device.config.endpoints);
            if (!taken || attempt == most_attempts) throw;
        }
    }
}

}  // namespace echoloop
