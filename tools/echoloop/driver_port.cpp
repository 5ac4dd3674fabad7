#include "tools/echoloop/driver_port.h"

namespace echoloop::cli {

using Scheme = Endpoint::Scheme;

std::string address_text(const std::string& host, int port) {
    return port == 0 ? host + ", the port is chosen at the start" : host + ":" + std::to_string(port);
}

int chosen_rate(const ScenarioDevice& device) {
    constexpr int usual_rate = 115200;
    const auto found = device.config.options.find("baud");
    const double* rate = found == device.config.options.end() ? nullptr : std::get_if<double>(&found->second);
    return rate != nullptr && *rate > 0 ? static_cast<int>(*rate) : usual_rate;
}

std::string stream_address(const Endpoint& end, int rate) {
    const auto bits = std::to_string(end.baud != 0 ? static_cast<int>(end.baud) : rate) + " bit/s 8N1";
    const std::string place = address_text(end.host, end.port);
    switch (end.scheme) {
        case Scheme::pty:
            return end.path + ", " + bits;
        case Scheme::serial:
            return "the other end of the cable on " + end.path + ", " + bits;
        case Scheme::tcp_listen:
            return "TCP, connect to " + place;
        case Scheme::tcp:
            return "TCP, listen on " + place;
        case Scheme::udp_listen:
            return "UDP, send to " + place;
        case Scheme::udp:
            return "UDP, listen on " + place;
    }
    return {};
}

SerialPort port_for_driver(const ScenarioDevice& device, const Endpoint& end) {
    const std::string link = "/tmp/" + device.name;
    const std::string pty = "socat PTY,link=" + link + ",raw,echo=0 ";
    const std::string place = address_text(end.host, end.port);
    const int rate = end.baud != 0 ? static_cast<int>(end.baud) : chosen_rate(device);
    switch (end.scheme) {
        case Scheme::pty:
            return {end.path, "", rate};
        case Scheme::serial:
            return {"/dev/ttyUSB1", "", rate};
        case Scheme::tcp_listen:
            return {link, pty + "TCP:" + place, rate};
        case Scheme::tcp:
            return {link, pty + "TCP-LISTEN:" + std::to_string(end.port), rate};
        case Scheme::udp_listen:
            return {link, pty + "UDP:" + place, rate};
        case Scheme::udp:
            return {link, pty + "UDP-LISTEN:" + std::to_string(end.port), rate};
    }
    return {};
}

}  // namespace echoloop::cli
