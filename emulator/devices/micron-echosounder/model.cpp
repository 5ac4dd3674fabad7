#include "emulator/devices/micron-echosounder/echosounder.h"

namespace echoloop::micron_echosounder {
namespace {

std::unique_ptr<Device> make(const DeviceConfig& config) {
    return std::make_unique<Echosounder>(read_settings(config),
                                         echosounder::read_wiring(config.endpoints, "micron-echosounder"));
}

Shot default_shot(const DeviceConfig& config, std::size_t step, double range) {
    return echosounder::plain_shot(read_settings(config).sounding, config.sound_speed, step, range);
}

}  // namespace

Model model() {
    Model m;
    m.name = "micron-echosounder";
    m.title = "Tritech Micron Echosounder (altimeter)";
    m.protocol = "ASCII lines, serial 9600 8N1";
    m.default_endpoints = {"pty:/tmp/echoloop/altimeter"};
    m.endpoint_schemes = {"pty", "serial", "tcp-listen", "tcp", "udp"};
    list_settings<Settings>(m);
    m.profile = built_in_profile(m.name);
    m.make = make;
    m.default_shot = default_shot;
    m.family = "altimeter";
    m.drivers = {{"rock",
                  "Rock sonar_tritech",
                  {"port: '{port}'         # properties of the oroGen task sonar_tritech::Echosounder",
                   "baudrate: {rate}"},
                  "it reads millimetres: options format mm and baud 115200"}};
    return m;
}

}  // namespace echoloop::micron_echosounder
