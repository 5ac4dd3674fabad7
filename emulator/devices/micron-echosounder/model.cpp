#include "emulator/devices/micron-echosounder/echosounder.h"

namespace echoloop::micron_echosounder {
namespace {

std::unique_ptr<Device> make(const DeviceConfig& config) {
    return std::make_unique<Echosounder>(read_settings(config),
                                         echosounder::read_wiring(config.endpoints, "micron-echosounder"));
}

}  // namespace

Model model() {
    Model m;
    m.name = "micron-echosounder";
    m.title = "Tritech Micron Echosounder (altimeter)";
    m.protocol = "ASCII lines, serial 9600 8N1";
    m.default_endpoints = {"pty:/tmp/echoloop/altimeter"};
    m.endpoint_schemes = {"pty", "serial", "tcp-listen", "tcp", "udp"};
    m.options = option_table();
    m.figures = echosounder::figure_table();
    m.profile = built_in_profile(m.name);
    m.make = make;
    m.default_shot = echosounder::plain_shot;
    m.family = "altimeter";
    return m;
}

}  // namespace echoloop::micron_echosounder
