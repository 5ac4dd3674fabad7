#include "tools/echoloop/driver_vehicle.h"

#include "tools/echoloop/driver_port.h"

namespace echoloop::cli {
namespace {

using Scheme = Endpoint::Scheme;

/// ArduPilot's numbers for kinds of range finders.
constexpr auto nmea_finder = "17";
constexpr auto ping_finder = "23";

std::vector<std::string> with_port(const SerialPort& port, std::vector<std::string> lines) {
    if (!port.preparation.empty()) lines.insert(lines.begin(), port.preparation);
    return lines;
}

/// At a real cable the driver's end has a name that nobody knows here.
std::string cable_note(const Endpoint& end, const SerialPort& port) {
    return end.scheme == Scheme::serial
               ? "write the port at the driver's end of the cable in place of " + port.path
               : "";
}

DriverHint ping360_ros1(const ScenarioDevice& device, const Endpoint& end) {
    const auto port = port_for_driver(device, end);
    return {"CentraleNantesRobotics ping360_sonar (branch melodic)",
            with_port(port, {"rosrun ping360_sonar ping360_node _device:=" + port.path +
                             " _baudrate:=" + std::to_string(port.rate) + " _frame:=" + device.name}),
            cable_note(end, port)};
}

DriverHint ping360_ros2(const ScenarioDevice& device, const Endpoint& end) {
    const std::string node = "ros2 run ping360_sonar ping360_node --ros-args -p fallback_emulated:=false -p ";
    DriverHint hint{"CentraleNantesRobotics ping360_sonar (branch ros2)", {}, ""};
    if (end.scheme == Scheme::udp_listen) {
        hint.paste = {node + "connection_type:=udp -p udp_address:=" + end.host +
                      " -p udp_port:=" + std::to_string(end.port)};
        return hint;
    }
    const auto port = port_for_driver(device, end);
    hint.paste =
        with_port(port, {node + "device:=" + port.path + " -p baudrate:=" + std::to_string(port.rate)});
    hint.note = cable_note(end, port);
    return hint;
}

DriverHint oculus_ros2() {
    return {"ENSTA Bretagne oculus_ros2",
            {"ros2 launch oculus_ros2 default.launch.py"},
            "it takes the first sonar whose status it hears on UDP 52102, so emulate one"};
}

/// "uart:/tmp/echoloop/ping1d:115200", as SITL names what a serial port of the autopilot is; empty: it
/// cannot.
std::string sitl_device(const Endpoint& end, const SerialPort& port) {
    const auto place = address_text(end.host, end.port);
    if (end.scheme == Scheme::tcp_listen) return "tcpclient:" + place;
    if (end.scheme == Scheme::udp_listen) return "udpclient:" + place;
    return port.preparation.empty() ? "uart:" + port.path + ":" + std::to_string(port.rate) : "";
}

DriverHint sitl_finder(const ScenarioDevice& device, const Endpoint& end, const std::string& type) {
    const auto port = port_for_driver(device, end);
    const auto line = sitl_device(end, port);
    if (line.empty()) return {};
    return {"ArduPilot's range finder, in SITL",
            {"sim_vehicle.py -v ArduSub -A \"--serial5=" + line + "\"", "param set SERIAL5_PROTOCOL 9",
             "param set SERIAL5_BAUD " + std::to_string(port.rate / 1000), "param set RNGFND1_TYPE " + type,
             "param set RNGFND1_ORIENT 25"},
            end.scheme == Scheme::serial
                ? cable_note(end, port)
                : "type the lines with param into its console, then restart it; 25 looks down"};
}

}  // namespace

DriverHint vehicle_driver_hint(const ScenarioDevice& device, const std::string& format) {
    const auto& model = device.model->name;
    const Endpoint& end = device.config.endpoints.at(0);
    if (model == "ping360" && format == "ros1") return ping360_ros1(device, end);
    if (model == "ping360" && format == "ros2") return ping360_ros2(device, end);
    if (model.starts_with("oculus-") && format == "ros2") return oculus_ros2();
    if (model == "ping1d" && format == "sitl") return sitl_finder(device, end, ping_finder);
    if (model == "nmea-echosounder" && format == "sitl") return sitl_finder(device, end, nmea_finder);
    return {};
}

}  // namespace echoloop::cli
