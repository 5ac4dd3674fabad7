#include "emulator/devices/family/sounder/talking_sounder.h"
#include "emulator/devices/nmea-echosounder/echosounder.h"

namespace echoloop::nmea_echosounder {
namespace {

constexpr std::size_t most_endpoints = 8;

std::unique_ptr<Device> make(const DeviceConfig& config) {
    const Settings settings = read_settings(config);
    const auto words = [settings](nmea::Depth depth, Time now) { return sentences(settings, depth, now); };
    return std::make_unique<echosounder::TalkingSounder>(
        settings.sounding, echosounder::read_wiring(config.endpoints, "nmea-echosounder", most_endpoints),
        words);
}

Shot default_shot(const DeviceConfig& config, std::size_t step, double range) {
    return echosounder::plain_shot(read_settings(config).sounding, config.sound_speed, step, range);
}

}  // namespace

Model model() {
    Model m;
    m.name = "nmea-echosounder";
    m.title = "NMEA 0183 single-beam echosounder";
    m.protocol = "NMEA 0183: DPT, DBT, MTW, serial 4800 8N1 or UDP";
    m.default_endpoints = {"pty:/tmp/echoloop/echosounder"};
    m.endpoint_schemes = {"pty", "serial", "tcp-listen", "tcp", "udp"};
    list_settings<Settings>(m);
    m.profile = built_in_profile(m.name);
    m.make = make;
    m.default_shot = default_shot;
    m.family = "nmea";
    m.drivers = {range_finder_in_sitl("17")};
    return m;
}

}  // namespace echoloop::nmea_echosounder
