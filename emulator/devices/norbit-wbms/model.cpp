#include <algorithm>
#include <stdexcept>

#include "emulator/contract/endpoint.h"
#include "emulator/devices/norbit-wbms/norbit_wbms.h"

namespace echoloop::norbit_device {
namespace {

constexpr double default_range = 30;  // m

void check_endpoints(const std::vector<Endpoint>& endpoints) {
    const auto listens = [](const Endpoint& endpoint) {
        return endpoint.scheme == Endpoint::Scheme::tcp_listen;
    };
    if (endpoints.size() != 3 || !std::all_of(endpoints.begin(), endpoints.end(), listens))
        throw std::invalid_argument(
            "a Norbit WBMS has three endpoints, for commands, bathymetry and water column, e.g. "
            "[\"tcp-listen://127.0.0.1:2209\", \"tcp-listen://127.0.0.1:2210\", "
            "\"tcp-listen://127.0.0.1:2211\"]");
}

std::unique_ptr<Device> make(const DeviceConfig& config) {
    check_endpoints(config.endpoints);
    return std::make_unique<NorbitWbms>(read_settings(config));
}

Shot default_shot(const DeviceConfig& config, std::size_t step, double range) {
    const Settings settings = read_settings(config);
    Controls controls = initial_controls(settings);
    controls.gate_mode = 0;
    controls.stop = range > 0 ? range : default_range;
    const Plan plan = make_plan(controls, settings, first_gain(settings));
    return make_shot(controls, plan, settings, static_cast<std::uint32_t>(step + 1));
}

}  // namespace

Model model() {
    Model m;
    m.name = "norbit-wbms";
    m.title = "Norbit WBMS multibeam sonar";
    m.protocol = "Norbit WBMS: text commands, bathymetry and water column, each on TCP";
    m.default_endpoints = {"tcp-listen://127.0.0.1:2209", "tcp-listen://127.0.0.1:2210",
                           "tcp-listen://127.0.0.1:2211"};
    m.endpoint_schemes = {"tcp-listen"};
    list_settings<Settings>(m);
    m.profile = built_in_profile(m.name);
    m.make = make;
    m.default_shot = default_shot;
    m.family = "norbit";
    m.drivers = {{"ros1",
                  "uri-ocean-robotics norbit",
                  {"rosparam load $(rospack find norbit)/config/norbit.yaml norbit_node",
                   "rosrun norbit norbit_node _ip:={host} _cmd_port:={number} _bathy_port:={number 2} "
                   "_water_column_port:={number 3} _sensor_frame:={name}"},
                  "its startup_settings in that file switch the sonar on"}};
    return m;
}

}  // namespace echoloop::norbit_device
