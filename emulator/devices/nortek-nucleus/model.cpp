#include <stdexcept>

#include "emulator/contract/endpoint.h"
#include "emulator/devices/nortek-nucleus/models.h"
#include "emulator/devices/nortek-nucleus/nucleus.h"

namespace echoloop::nortek_nucleus {
namespace {

/// The first TCP port takes commands, the second says data alone; one serial line does both.
std::vector<Speech> read_ports(const std::vector<Endpoint>& endpoints) {
    std::vector<Speech> ports;
    std::size_t listeners = 0, lines = 0;
    for (const Endpoint& e : endpoints) {
        const bool listens = e.scheme == Endpoint::Scheme::tcp_listen;
        const bool serial = e.scheme == Endpoint::Scheme::pty || e.scheme == Endpoint::Scheme::serial;
        listeners += listens ? 1 : 0;
        lines += serial ? 1 : 0;
        if (listeners > 2 || lines > 1 || (!listens && !serial))
            throw std::invalid_argument(to_string(e) +
                                        ": a Nucleus has up to two TCP ports, for commands and for data "
                                        "alone, and one serial line, e.g. "
                                        "[\"tcp-listen://127.0.0.1:9000\", \"tcp-listen://127.0.0.1:9002\", "
                                        "\"pty:/tmp/echoloop/nucleus\"]");
        ports.push_back(serial ? Speech::line : listeners == 1 ? Speech::commands : Speech::data);
    }
    if (ports.empty()) throw std::invalid_argument("a Nucleus has at least one endpoint");
    return ports;
}

std::unique_ptr<Device> make(const DeviceConfig& config) {
    return std::make_unique<Nucleus>(read_settings(config), read_ports(config.endpoints));
}

/// In the first mode whose depths reach out to `range`.
Shot default_shot(const DeviceConfig& config, std::size_t step, double range) {
    constexpr double usual = 20;  // m
    const Settings settings = read_settings(config);
    const auto modes =
        doppler::usual_modes(settings.acoustics.lowest_altitude, settings.acoustics.highest_altitude);
    std::size_t mode = 0;
    while (mode + 1 < modes.size() && modes[mode].farthest < (range > 0 ? range : usual)) ++mode;
    return make_shot(doppler::make_plan(modes[mode], config.sound_speed, settings), settings, step + 1);
}

}  // namespace

Model model() {
    Model m;
    m.name = "nortek-nucleus";
    m.title = "Nortek Nucleus1000 Doppler velocity log";
    m.protocol = "Nortek's frames and commands, TCP or serial 115200 8N1";
    m.default_endpoints = {"tcp-listen://127.0.0.1:9000"};
    m.endpoint_schemes = {"tcp-listen", "pty", "serial"};
    list_settings<Settings>(m);
    m.profile = built_in_profile(m.name);
    m.make = make;
    m.default_shot = default_shot;
    m.family = "nortek";
    m.drivers = {{"python",
                  "NortekSupport nucleus_driver",
                  {"driver = NucleusDriver()", "driver.set_tcp_configuration(host=\"{host}\")",
                   "driver.connect(connection_type=\"tcp\")", "driver.start_measurement()"},
                  "it has port 9000 by itself",
                  "tcp-listen"},
                 {"python",
                  "NortekSupport nucleus_driver, serial",
                  {"driver = NucleusDriver()", "driver.set_serial_configuration(port=\"{port}\")",
                   "driver.connect(connection_type=\"serial\")", "driver.start_measurement()"}}};
    return m;
}

}  // namespace echoloop::nortek_nucleus
