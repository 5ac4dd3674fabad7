#include "tools/echoloop/driver_seanet.h"

namespace echoloop::cli {
namespace {

using Scheme = Endpoint::Scheme;

constexpr auto line_rate = "115200";  // of every SeaNet driver

/// The serial port that a driver opens, and what makes it exist if the emulator does not.
struct SerialPort {
    std::string path;
    std::string preparation;
};

SerialPort port_for_driver(const ScenarioDevice& device, const Endpoint& end) {
    const std::string link = "/tmp/" + device.name;
    const std::string pty = "socat PTY,link=" + link + ",raw,echo=0 ";
    const std::string place = end.host + ":" + std::to_string(end.port);
    switch (end.scheme) {
        case Scheme::pty:
            return {end.path, ""};
        case Scheme::serial:
            return {"/dev/ttyUSB1", ""};
        case Scheme::tcp_listen:
            return {link, pty + "TCP:" + place};
        case Scheme::tcp:
            return {link, pty + "TCP-LISTEN:" + std::to_string(end.port)};
        case Scheme::udp_listen:
            return {link, pty + "UDP:" + place};
        case Scheme::udp:
            return {link, pty + "UDP-LISTEN:" + std::to_string(end.port)};
    }
    return {};
}

std::vector<std::string> rock_lines(const Endpoint& end, const std::string& path) {
    const bool tcp = end.scheme == Scheme::tcp_listen;
    const auto uri =
        tcp ? "tcp://" + end.host + ":" + std::to_string(end.port) : "serial://" + path + ":" + line_rate;
    std::vector<std::string> lines;
    if (!tcp) lines.push_back("sonar_tritech_bin " + path);
    lines.push_back("io_port: '" + uri + "'      # property of the oroGen task sonar_tritech::Micron");
    return lines;
}

std::vector<std::string> moos_lines(const std::string& path) {
    return {"ProcessConfig = iSonar",    "{",
            "  AppTick     = 4",         "  CommsTick   = 4",
            "  SERIAL_PORT = " + path,   "  SONAR_TYPE  = Micron",
            "  POWERED_AT_START = true", "}"};
}

std::vector<std::string> ros2_lines(const std::string& path) {
    return {"micron_sonar_node:", "  ros__parameters:", "    port: \"" + path + "\"",
            std::string("    baudrate: ") + line_rate};
}

}  // namespace

std::string stream_address(const Endpoint& end, int rate) {
    const auto bits = std::to_string(end.baud != 0 ? static_cast<int>(end.baud) : rate) + " bit/s 8N1";
    const std::string place = end.host + ":" + std::to_string(end.port);
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

DriverHint seanet_driver_hint(const ScenarioDevice& device, const std::string& format) {
    const auto end = parse_endpoint(device.config.endpoints.at(0));
    const auto [path, preparation] = port_for_driver(device, end);
    DriverHint hint;
    if (format == "ros1") {
        hint = {"tritech_micron (branch noetic)",
                {"rosrun tritech_micron scan.py _port:=" + path + " _frame:=" + device.name},
                ""};
    } else if (format == "ros2") {
        hint = {
            "labust tritech_sonar_driver", ros2_lines(path),
            "goes into config/micron_sonar_node_params.yaml; start it with ros2 launch drivers_sonar_tritech "
            "micron_sonar_node.launch.py"};
    } else if (format == "moos") {
        hint = {"moos-ivp-enstabretagne iSonar", moos_lines(path), ""};
    } else if (format == "rock") {
        hint = {"Rock sonar_tritech", rock_lines(end, path), ""};
    }
    const bool direct = format == "rock" && end.scheme == Scheme::tcp_listen;
    if (!hint.driver.empty() && !preparation.empty() && !direct)
        hint.paste.insert(hint.paste.begin(), preparation);
    if (!hint.driver.empty() && end.scheme == Scheme::serial)
        hint.note = "write the port at the driver's end of the cable in place of " + path;
    return hint;
}

}  // namespace echoloop::cli
