#include "emulator/devices/nmea-ins/ins.h"

namespace echoloop::nmea_ins {
namespace {

constexpr std::size_t most_endpoints = 8;

std::unique_ptr<Device> make(const DeviceConfig& config) {
    auto wiring = talker::read_wiring(config.endpoints, "nmea-ins", most_endpoints);
    return std::make_unique<NavigationUnit>(read_settings(config), std::move(wiring));
}

std::vector<KnownDriver> drivers() {
    return {{"ros1",
             "nmea_navsat_driver",
             {"rosrun nmea_navsat_driver nmea_serial_driver _port:={port} _baud:={rate}"},
             "it reads GGA, VTG and HDT of the first endpoint"},
            {"ros2",
             "nmea_navsat_driver",
             {"ros2 run nmea_navsat_driver nmea_serial_driver --ros-args -p port:={port} -p baud:={rate}"},
             "it reads GGA, VTG and HDT of the first endpoint"},
            {"python",
             "pynmea2",
             {"import pynmea2, serial", "for line in serial.Serial('{port}', {rate}):",
              "    print(repr(pynmea2.parse(line.decode())))"},
             "it needs pynmea2 and pyserial, and prints every sentence of the first endpoint"}};
}

}  // namespace

Model model() {
    Model m;
    m.name = "nmea-ins";
    m.title = "inertial navigation unit with satellite receiver and compass";
    m.protocol = "NMEA 0183: GGA, ZDA, VTG, HDT, PASHR; TSS1; EM Attitude 3000; serial or UDP";
    m.default_endpoints = {"pty:/tmp/echoloop/ins", "pty:/tmp/echoloop/ins-tss1",
                           "pty:/tmp/echoloop/ins-em3000"};
    m.endpoint_schemes = {"pty", "serial", "tcp-listen", "tcp", "udp"};
    list_settings<Settings>(m);
    m.profile = built_in_profile(m.name);
    m.make = make;
    m.family = "nmea";
    m.drivers = drivers();
    return m;
}

}  // namespace echoloop::nmea_ins
