#include "tools/echoloop/driver_seanet.h"

#include "tools/echoloop/driver_port.h"

namespace echoloop::cli {
namespace {

using Scheme = Endpoint::Scheme;

constexpr auto seanet_rate = "115200";  // of every SeaNet driver

std::vector<std::string> rock_lines(const Endpoint& end, const std::string& path) {
    const bool tcp = end.scheme == Scheme::tcp_listen;
    const auto uri =
        tcp ? "tcp://" + end.host + ":" + std::to_string(end.port) : "serial://" + path + ":" + seanet_rate;
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
            std::string("    baudrate: ") + seanet_rate};
}

}  // namespace

DriverHint seanet_driver_hint(const ScenarioDevice& device, const std::string& format) {
    const Endpoint& end = device.config.endpoints.at(0);
    const auto [path, preparation, _] = port_for_driver(device, end);
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
