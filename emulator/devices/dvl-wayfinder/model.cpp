#include "emulator/contract/endpoint.h"
#include "emulator/devices/dvl-wayfinder/dvl.h"

namespace echoloop::dvl_wayfinder {
namespace {

std::unique_ptr<Device> make(const DeviceConfig& config) {
    return std::make_unique<Dvl>(read_settings(config));
}

/// In the first mode whose depths reach out to `range`.
Shot default_shot(const DeviceConfig& config, std::size_t step, double range) {
    constexpr double usual = 20;  // m
    const Settings settings = read_settings(config);
    const doppler::Acoustics& a = settings.acoustics;
    const auto modes = doppler::usual_modes(a.lowest_altitude, a.highest_altitude);
    std::size_t mode = 0;
    while (mode + 1 < modes.size() && modes[mode].farthest < (range > 0 ? range : usual)) ++mode;
    return doppler::make_shot(doppler::make_plan(modes[mode], config.sound_speed, settings), settings,
                              step + 1);
}

}  // namespace

Model model() {
    Model m;
    m.name = "dvl-wayfinder";
    m.title = "Teledyne Wayfinder Doppler velocity log";
    m.protocol = "Wayfinder packets, serial 115200 8N1";
    m.default_endpoints = {"pty:/tmp/echoloop/dvl-wayfinder"};
    m.endpoint_schemes = {"pty", "serial", "tcp-listen"};
    list_settings<Settings>(m);
    m.profile = built_in_profile(m.name);
    m.make = make;
    m.default_shot = default_shot;
    m.family = "wayfinder";
    m.drivers = {
        {"python",
         "Teledyne-Marine Wayfinder",
         {"import serial", "serial.Serial.setDTR = serial.Serial.setRTS = lambda port, on=True: None",
          "from dvl.dvl import Dvl", "log = Dvl(\"{port}\", {rate})", "print(log.is_connected())",
          "log.register_ondata_callback(lambda data, _: print(data.vel_x, data.vel_y, data.mean_range))"},
         "it wants modem lines, which a pty has not; the second line does without them",
         "pty"},
        {"python",
         "Teledyne-Marine Wayfinder",
         {"from dvl.dvl import Dvl", "log = Dvl(\"{port}\", {rate})", "print(log.is_connected())",
          "log.register_ondata_callback(lambda data, _: print(data.vel_x, data.vel_y, data.mean_range))"}}};
    return m;
}

}  // namespace echoloop::dvl_wayfinder
