#include "emulator/transport/make.h"

#include "emulator/endpoint.h"
#include "emulator/error.h"
#include "emulator/transport/paced.h"
#include "emulator/transport/pty.h"
#include "emulator/transport/serial.h"
#include "emulator/transport/tcp.h"
#include "emulator/transport/udp.h"

namespace echoloop {
namespace {

constexpr double usual_baud = 115200;

/// The device's own line rate, bit/s; 0 if it is not paced.
double line_rate(const DeviceConfig& config) {
    const auto found = config.options.find("baud");
    if (found == config.options.end()) return 0;
    const double* rate = std::get_if<double>(&found->second);
    return rate ? *rate : 0;
}

std::unique_ptr<Transport> open_stream(asio::io_context& io, const Endpoint& e, double rate) {
    using Scheme = Endpoint::Scheme;
    switch (e.scheme) {
        case Scheme::pty:
            return std::make_unique<Pty>(io, e.path);
        case Scheme::serial: {
            const double own = rate > 0 ? rate : usual_baud;
            return std::make_unique<SerialPort>(io, e.path, static_cast<int>(e.baud != 0 ? e.baud : own));
        }
        case Scheme::tcp_listen:
            return std::make_unique<TcpListener>(io, Address{e.ip, e.port});
        case Scheme::tcp:
            return std::make_unique<TcpClient>(io, e.host, e.port);
        case Scheme::udp_listen:
            return std::make_unique<Udp>(io, Address{e.ip, e.port}, false);
        case Scheme::udp: {
            constexpr std::uint32_t loopback = 0x7F000001;
            const bool local = e.ip >> 24 == 127;
            return std::make_unique<Udp>(io, Address{local ? loopback : 0, e.local_port()}, false,
                                         Address{e.ip, e.port});
        }
    }
    throw StartError(Exit::software, "endpoint of an unknown kind");
}

std::unique_ptr<Transport> open_line(Clock& clock, const std::string& uri, double rate) {
    const Endpoint endpoint = parse_endpoint(uri);
    auto line = open_stream(clock.io(), endpoint, rate);
    if (rate <= 0 || endpoint.scheme == Endpoint::Scheme::serial) return line;
    return std::make_unique<Paced>(clock, std::move(line), rate);
}

}  // namespace

std::unique_ptr<Transport> open_endpoint(asio::io_context& io, const std::string& uri) {
    return open_stream(io, parse_endpoint(uri), 0);
}

std::vector<std::unique_ptr<Transport>> make_transports(Clock& clock, const std::vector<Port>& ports,
                                                        const DeviceConfig& config) {
    std::vector<std::unique_ptr<Transport>> transports;
    std::size_t next_stream = 0;
    for (const Port& port : ports) {
        if (port.kind == Port::Kind::datagram)
            transports.push_back(std::make_unique<Udp>(clock.io(), port.bind, port.shared));
        else
            transports.push_back(open_line(clock, config.endpoints.at(next_stream++), line_rate(config)));
    }
    return transports;
}

}  // namespace echoloop
