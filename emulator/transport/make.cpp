#include "emulator/transport/make.h"

#include "emulator/clock/stepped_clock.h"
#include "emulator/contract/endpoint.h"
#include "emulator/contract/error.h"
#include "emulator/contract/options.h"
#include "emulator/contract/random_key.h"
#include "emulator/transport/baud_check.h"
#include "emulator/transport/driver_lines.h"
#include "emulator/transport/paced.h"
#include "emulator/transport/pty.h"
#include "emulator/transport/scripted_line.h"
#include "emulator/transport/serial.h"
#include "emulator/transport/stepped_port.h"
#include "emulator/transport/tcp.h"
#include "emulator/transport/udp.h"
#include "emulator/transport/usb_adapter.h"

namespace echoloop {
namespace {

/// The device's own end of a serial line.
struct OwnEnd {
    double rate = 0;  ///< bit/s; 0: not paced
    Paced::OtherRate other = Paced::OtherRate::ignored;
};

/// Devices call the port of their serial line "line", with a number where there are several. By TCP it stands
/// for a server of that line, and is as slow; other ports are sockets of the device's own.
bool is_serial_line(const Port& port) { return port.name.starts_with("line"); }

/// By the options "baud" and "automatic_baud", where a model has them.
OwnEnd own_end(const DeviceConfig& config, const Port& port, const Endpoint& endpoint) {
    if (!is_serial_line(port)) return {};
    const auto baud = config.options.find("baud"), automatic = config.options.find("automatic_baud");
    OwnEnd end;
    if (baud == config.options.end()) return end;
    end.rate = number(config.options, "baud");
    const bool follows = automatic != config.options.end() && flag(config.options, "automatic_baud");
    if (endpoint.scheme == Endpoint::Scheme::pty)
        end.other = follows                                  ? Paced::OtherRate::followed
                    : end.rate > 0 && endpoint.checks_baud() ? Paced::OtherRate::garbage
                                                             : Paced::OtherRate::ignored;
    return end;
}

/// Tells the places of a stepped run apart; "" in others.
std::string steady_name(Clock& clock, const DeviceConfig& config, const Port& port) {
    return dynamic_cast<SteppedClock*>(&clock) != nullptr ? config.name + '/' + port.name : "";
}

/// Where the system may choose the port, and the place has a steady name: the same port in every run, if it
/// is free, so that equal runs have equal recordings.
std::unique_ptr<Udp> open_datagrams(asio::io_context& io, Address bind, bool shared, const Peers& peers,
                                    Address to, const std::string& steady) {
    constexpr std::uint16_t first = 49152, ports = 16384;  // of the dynamic ones (RFC 6335)
    constexpr std::uint64_t tries = 8;
    if (bind.port == 0 && !steady.empty()) {
        for (std::uint64_t i = 0; i < tries; ++i) {
            const auto port = static_cast<std::uint16_t>(first + random_key(i, steady) % ports);
            try {
                return std::make_unique<Udp>(io, Address{bind.ip, port}, shared, peers, to);
            } catch (const StartError&) {  // somebody has it
            }
        }
    }
    return std::make_unique<Udp>(io, bind, shared, peers, to);
}

std::unique_ptr<Transport> open_stream(asio::io_context& io, const Endpoint& e, double rate,
                                       const std::string& steady, Browsers browsers,
                                       std::span<const Network> named) {
    using Scheme = Endpoint::Scheme;
    switch (e.scheme) {
        case Scheme::pty:
            return std::make_unique<Pty>(io, e.path, e.group());
        case Scheme::serial:
            return std::make_unique<SerialPort>(io, e.path, static_cast<int>(line_rate({&e, 1}, rate)));
        case Scheme::tcp_listen:
            return std::make_unique<TcpListener>(
                std::make_shared<TcpDoor>(io, Address{e.ip, e.port},
                                          Manners{.speaks_http = browsers == Browsers::served,
                                                  .idle = e.idle(),
                                                  .peers = Peers(e.ip, named)}));
        case Scheme::tcp:
            return std::make_unique<TcpClient>(io, e.host, e.port);
        case Scheme::udp_listen:
            return open_datagrams(io, {e.ip, e.port}, false, Peers(e.ip, named), {}, steady);
        case Scheme::udp: {
            constexpr std::uint32_t loopback = 0x7F000001;
            const std::uint32_t own = is_loopback(e.ip) ? loopback : 0;
            return open_datagrams(io, {own, e.local_port()}, false, Peers(own, named, {&e.ip, 1}),
                                  {e.ip, e.port}, steady);
        }
    }
    throw StartError(Exit::software, "endpoint of an unknown kind");
}

/// What a port is opened as, before anything lies around it.
struct Opened {
    std::unique_ptr<Transport> wire;
    std::shared_ptr<TcpDoor> door;  ///< instead, where each driver has a line of its own
};

bool has_driver_lines(const Port& port, const Endpoint& endpoint) {
    return (port.drivers > 1 || port.messages_kept > 0) && endpoint.scheme == Endpoint::Scheme::tcp_listen;
}

Opened open_port(asio::io_context& io, const Port& port, const Endpoint& endpoint, const DeviceConfig& config,
                 const std::string& steady) {
    if (!has_driver_lines(port, endpoint))
        return {open_stream(io, endpoint, own_end(config, port, endpoint).rate, steady, Browsers::turned_away,
                            config.peers),
                nullptr};
    constexpr int few_messages = 256 << 10;  // B, which the system doubles
    const Manners manners{port.messages_kept > 0 ? few_messages : 0, port.answers_half_closed,
                          port.speaks_http, endpoint.idle(), Peers(endpoint.ip, config.peers)};
    return {nullptr, std::make_shared<TcpDoor>(io, Address{endpoint.ip, endpoint.port}, manners)};
}

/// A stream as slow as a serial line, if it is one.
std::unique_ptr<Transport> paced(Clock& clock, std::unique_ptr<Transport> line, const Endpoint& endpoint,
                                 const OwnEnd& own) {
    if (endpoint.usb_latency() > 0)
        line = std::make_unique<UsbAdapter>(clock, std::move(line),
                                            std::chrono::milliseconds(endpoint.usb_latency()));
    const bool paced = own.rate > 0 || own.other == Paced::OtherRate::followed;
    const bool real = endpoint.scheme == Endpoint::Scheme::serial, udp = line->wire().kind == Wire::Kind::udp;
    if (!paced || real || udp) return line;
    return std::make_unique<Paced>(clock, std::move(line), own.rate, own.other);
}

std::unique_ptr<Transport> line_of(Clock& clock, std::unique_ptr<Transport> opened, const Endpoint& endpoint,
                                   const DeviceConfig& config, const Port& port, const Around& around) {
    const OwnEnd own = own_end(config, port, endpoint);
    auto wire = around(paced(clock, in_step(clock, std::move(opened)), endpoint, own), port);
    if (own.other != Paced::OtherRate::garbage) return wire;
    return std::make_unique<BaudCheck>(clock, std::move(wire), own.rate, config.name);
}

std::unique_ptr<Transport> driver_lines(Clock& clock, const std::shared_ptr<TcpDoor>& door,
                                        const Endpoint& endpoint, const DeviceConfig& config,
                                        const Port& port, const Around& around) {
    const OwnEnd own = own_end(config, port, endpoint);
    std::vector<std::unique_ptr<Transport>> lines;
    for (std::size_t i = 0; i < port.drivers; ++i)
        lines.push_back(
            around(paced(clock, in_step(clock, std::make_unique<TcpListener>(door)), endpoint, own), port));
    const auto slow = port.slow_holds_up ? DriverLines::Slow::holds_up : DriverLines::Slow::loses;
    if (port.messages_kept == 0) return std::make_unique<DriverLines>(clock, std::move(lines), slow);
    return std::make_unique<DriverLines>(clock, std::move(lines), slow, port.messages_kept);
}

/// The two ends of a port that is not opened; the `index` tells the drivers' ports apart.
Wire wire_of(const Port& port, const Endpoint* endpoint, std::size_t index) {
    constexpr std::uint32_t loopback = 0x7F000001;
    constexpr std::uint16_t first_driver = 50000, first_device = 49152;  // dynamic ports (RFC 6335)
    const Address driver{loopback, static_cast<std::uint16_t>(first_driver + index)};
    const auto numbered = [&](Address own) {
        if (own.ip == 0) own.ip = loopback;
        if (own.port == 0) own.port = static_cast<std::uint16_t>(first_device + index);
        return own;
    };
    using Scheme = Endpoint::Scheme;
    if (port.kind == Port::Kind::datagram) return {Wire::Kind::udp, numbered(port.bind), driver};
    const Address named{endpoint->ip, endpoint->port};
    switch (endpoint->scheme) {
        case Scheme::pty:
        case Scheme::serial:
            return {};
        case Scheme::tcp_listen:
            return {Wire::Kind::tcp_server, numbered(named), driver};
        case Scheme::tcp:
            return {Wire::Kind::tcp_client, numbered({}), named};
        case Scheme::udp_listen:
            return {Wire::Kind::udp, numbered(named), driver};
        case Scheme::udp:
            return {Wire::Kind::udp, numbered({0, endpoint->local_port()}), named};
    }
    throw StartError(Exit::software, "endpoint of an unknown kind");
}

std::unique_ptr<Transport> as_it_is(std::unique_ptr<Transport> wire, const Port&) { return wire; }

}  // namespace

const Endpoint& endpoint_of(const Port& port, const std::vector<Endpoint>& endpoints,
                            std::size_t& next_stream) {
    if (port.endpoint) return endpoints.at(*port.endpoint);
    return endpoints.at(next_stream++);
}

std::unique_ptr<Transport> open_endpoint(asio::io_context& io, const std::string& uri, Browsers browsers,
                                         std::span<const Network> peers) {
    return open_stream(io, parse_endpoint(uri), 0, "", browsers, peers);
}

std::vector<std::unique_ptr<Transport>> make_transports(Clock& clock, const std::vector<Port>& ports,
                                                        const DeviceConfig& config, const Around& around) {
    const Around wrap = around ? around : as_it_is;
    std::vector<std::uint32_t> destinations;  // that the scenario names
    for (const Endpoint& endpoint : config.endpoints)
        if (endpoint.scheme == Endpoint::Scheme::udp) destinations.push_back(endpoint.ip);
    std::vector<Opened> opened;  // all of them, before anything learns of one
    std::size_t next_stream = 0;
    for (const Port& port : ports) {
        const std::string steady = steady_name(clock, config, port);
        if (port.kind == Port::Kind::datagram)
            opened.push_back({open_datagrams(clock.io(), port.bind, port.shared,
                                             Peers(port.bind.ip, config.peers, destinations), {}, steady),
                              nullptr});
        else
            opened.push_back(open_port(clock.io(), port, endpoint_of(port, config.endpoints, next_stream),
                                       config, steady));
    }
    std::vector<std::unique_ptr<Transport>> transports;
    next_stream = 0;
    for (std::size_t i = 0; i < ports.size(); ++i) {
        auto& [wire, door] = opened[i];
        if (ports[i].kind == Port::Kind::datagram) {
            transports.push_back(wrap(in_step(clock, std::move(wire)), ports[i]));
            continue;
        }
        const Endpoint& endpoint = endpoint_of(ports[i], config.endpoints, next_stream);
        transports.push_back(door ? driver_lines(clock, door, endpoint, config, ports[i], wrap)
                                  : line_of(clock, std::move(wire), endpoint, config, ports[i], wrap));
    }
    return transports;
}

std::vector<std::unique_ptr<Transport>> make_scripted_transports(Clock& clock, const std::vector<Port>& ports,
                                                                 const DeviceConfig& config,
                                                                 std::span<const DriverLine> script,
                                                                 const Around& around) {
    const Around wrap = around ? around : as_it_is;
    std::vector<std::unique_ptr<Transport>> transports;
    std::size_t next_stream = 0;
    for (std::size_t i = 0; i < ports.size(); ++i) {
        std::vector<DriverLine> lines;
        for (const DriverLine& line : script)
            if (line.port == i) lines.push_back(line);
        const bool stream = ports[i].kind == Port::Kind::stream;
        const Endpoint* const endpoint =
            stream ? &endpoint_of(ports[i], config.endpoints, next_stream) : nullptr;
        auto line = std::make_unique<ScriptedLine>(clock, wire_of(ports[i], endpoint, i), std::move(lines));
        if (!stream) {
            transports.push_back(wrap(std::move(line), ports[i]));
            continue;
        }
        Endpoint cable = *endpoint;
        OwnEnd own = own_end(config, ports[i], *endpoint);
        own.other = Paced::OtherRate::ignored;  // the driver has the device's rate
        if (std::exchange(cable.scheme, Endpoint::Scheme::pty) == Endpoint::Scheme::serial)
            own.rate = line_rate({endpoint, 1}, own.rate);  // nothing else paces it
        transports.push_back(wrap(paced(clock, std::move(line), cable, own), ports[i]));
    }
    return transports;
}

}  // namespace echoloop
