#include <stdexcept>

#include "emulator/devices/nmea-echosounder/echosounder.h"
#include "emulator/endpoint.h"

namespace echoloop::nmea_echosounder {
namespace {

Wiring read_wiring(const std::vector<std::string>& endpoints) {
    if (endpoints.size() != 1)
        throw std::invalid_argument("an nmea-echosounder has one talker port: give exactly one endpoint");
    const Endpoint e = parse_endpoint(endpoints[0]);
    if (e.scheme == Endpoint::Scheme::udp_listen)
        throw std::invalid_argument(endpoints[0] +
                                    ": an echosounder listens to nobody; name the host that is "
                                    "to hear it, udp://ADDRESS:PORT");
    if (e.scheme != Endpoint::Scheme::udp) return {{"line", Port::Kind::stream, {}, false}, {}};
    constexpr std::uint32_t loopback = 0x7F000001;
    const Address from{e.ip >> 24 == 127 ? loopback : 0, e.local_port()};
    return {{"sentences", Port::Kind::datagram, from, false}, {e.ip, e.port}};
}

std::unique_ptr<Device> make(const DeviceConfig& config) {
    return std::make_unique<Echosounder>(read_settings(config), read_wiring(config.endpoints));
}

Shot default_shot(const DeviceConfig& config, std::size_t step, double range) {
    Settings settings = read_settings(config);
    if (range > 0) settings.range = range * settings.sound_speed / config.sound_speed;
    Shot shot = shot_from(settings);
    shot.ping = step + 1;
    return shot;
}

}  // namespace

Model model() {
    Model m;
    m.name = "nmea-echosounder";
    m.title = "NMEA 0183 single-beam echosounder";
    m.protocol = "NMEA 0183: DPT, DBT, MTW, serial 4800 8N1 or UDP";
    m.default_endpoints = {"pty:/tmp/echoloop/echosounder"};
    m.endpoint_schemes = {"pty", "serial", "tcp-listen", "tcp", "udp"};
    m.options = option_table();
    m.figures = figure_table();
    m.profile = built_in_profile(m.name);
    m.make = make;
    m.default_shot = default_shot;
    return m;
}

}  // namespace echoloop::nmea_echosounder
