#include "emulator/devices/family/ping/known_drivers.h"
#include "emulator/devices/surveyor240/surveyor240.h"

namespace echoloop::surveyor240 {
namespace {

std::unique_ptr<Device> make(const DeviceConfig& config) {
    return std::make_unique<Surveyor240>(read_settings(config), config.endpoints);
}

Shot default_shot(const DeviceConfig& config, std::size_t step, double range) {
    const Settings settings = read_settings(config);
    Parameters parameters = default_parameters();
    parameters.sos_mps = static_cast<float>(config.sound_speed);
    Plan plan = make_plan(parameters, {}, settings);
    if (range > 0) plan.end = range;
    return make_shot(plan, settings, static_cast<std::uint32_t>(step + 1));
}

}  // namespace

Model model() {
    Model m;
    m.name = "surveyor240";
    m.title = "Cerulean Surveyor 240-16 multibeam echosounder";
    m.protocol = "Ping protocol with Cerulean's messages, TCP or UDP";
    m.default_endpoints = {"tcp-listen://127.0.0.1:62312"};
    m.endpoint_schemes = {"tcp-listen", "tcp", "udp-listen", "udp", "pty", "serial"};
    list_settings<Settings>(m);
    m.profile = built_in_profile(m.name);
    m.make = make;
    m.default_shot = default_shot;
    m.family = "cerulean";
    m.drivers =
        ping_device::brping_drivers("0.2.3", "Surveyor240", {"print(sonar.readDeviceInformation())"}, true);
    return m;
}

}  // namespace echoloop::surveyor240
