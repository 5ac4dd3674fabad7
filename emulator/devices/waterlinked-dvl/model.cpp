#include <algorithm>
#include <stdexcept>

#include "emulator/contract/endpoint.h"
#include "emulator/devices/waterlinked-dvl/dvl.h"
#include "emulator/devices/waterlinked-dvl/models.h"

namespace echoloop::waterlinked_dvl {
namespace {

/// TCP ports speak JSON, HTTP, PD6 and PD4 in this order, lines the serial protocol.
Wiring read_wiring(const std::vector<Endpoint>& endpoints) {
    constexpr Speech of_tcp[] = {Speech::json, Speech::http, Speech::pd6, Speech::pd4};
    Wiring wiring;
    std::size_t listeners = 0;
    bool line = false;
    for (const Endpoint& e : endpoints) {
        const bool listens = e.scheme == Endpoint::Scheme::tcp_listen;
        const bool serial = e.scheme == Endpoint::Scheme::pty || e.scheme == Endpoint::Scheme::serial;
        if ((listens && listeners == std::size(of_tcp)) || (serial && line) || (!listens && !serial))
            throw std::invalid_argument(
                to_string(e) +
                ": a DVL has up to four TCP ports, for JSON, HTTP, PD6 and PD4 in this order, and one serial "
                "line, e.g. [\"tcp-listen://127.0.0.1:16171\", \"pty:/tmp/echoloop/dvl\"]");
        wiring.ports.push_back(serial ? Speech::serial : of_tcp[listeners]);
        wiring.numbers.push_back(serial ? 0 : e.port);
        if (listens && wiring.address.empty()) wiring.address = e.host;
        listeners += listens ? 1 : 0;
        line = line || serial;
    }
    if (wiring.ports.empty()) throw std::invalid_argument("a DVL has at least one endpoint");
    return wiring;
}

template <const char* product>
std::unique_ptr<Device> make(const DeviceConfig& config) {
    return std::make_unique<Dvl>(read_settings(config, product), read_wiring(config.endpoints));
}

/// In the mode whose altitudes reach out to `range`.
Shot default_shot(const DeviceConfig& config, std::size_t step, double range) {
    constexpr std::size_t usual = 2;
    const Settings settings = read_settings(config, "");
    const Modes modes = range_modes(settings.acoustics.highest_altitude);
    std::size_t mode = usual;
    if (range > 0)
        for (mode = 0; mode + 1 < modes.size() && modes[mode].farthest < range;) ++mode;
    return make_shot(make_plan(modes[mode], config.sound_speed, settings), settings, step + 1);
}

constexpr char a50[] = "DVL A50", a125[] = "DVL A125";

Model row(const std::string& name, const std::string& title, const std::string& in_dune) {
    Model m;
    m.name = name;
    m.title = title;
    m.protocol = "JSON by TCP, serial protocol 115200 8N1, PD6 and PD4 by TCP, HTTP";
    m.default_endpoints = {"tcp-listen://127.0.0.1:16171"};
    m.endpoint_schemes = {"tcp-listen", "pty", "serial"};
    list_settings<Settings>(m);
    m.profile = built_in_profile(m.name);
    m.default_shot = default_shot;
    m.family = "waterlinked";
    m.drivers = {
        {"ros2",
         "Robotic-Decision-Making-Lab waterlinked_dvl",
         {"ros2 run waterlinked_dvl_driver waterlinked_dvl_driver --ros-args -p ip_address:={host} -p "
          "port:={number}"},
         "it throws at reports of water tracking unless option water_type is velocity"},
        {"ros2",
         "paagutie dvl-a50",
         {"ros2 run dvl_a50 dvl_a50_sensor --ros-args -p dvl_ip_address:={host}"},
         "it has port 16171 only, and switches acoustics off until its service enables them"},
        {"python",
         "waterlinked dvl-python",
         {"python3 dvl_tcp_parser.py velocity --ip {host}"},
         "it has port 16171 only"},
        {"python",
         "waterlinked dvl-python, serial",
         {"from wldvl import WlDVL", "WlDVL(\"{port}\").read()"},
         "it reads wrx only: option serial_output v1_v2"},
        {"dune",
         "LSTS DUNE",
         {"[Sensors.WaterLinkedDVL]", "Enabled = Hardware", "Entity Label = {name}", "Activation Time = 30",
          "DVL Model = " + in_dune, "Device Orientation = 0, -90, 0", "Acoustics Activation = Always",
          "IO Port - Device = tcp://{host}:{number}"},
         "goes into the vehicle's .ini file",
         "tcp-listen"}};
    return m;
}

}  // namespace

std::vector<Model> models() {
    std::vector<Model> all{row("dvl-a50", "Water Linked DVL A50 Doppler velocity log", "A50"),
                           row("dvl-a125", "Water Linked DVL A125 Doppler velocity log", "A125")};
    all[0].make = make<a50>;
    all[1].make = make<a125>;
    return all;
}

}  // namespace echoloop::waterlinked_dvl
