#include <stdexcept>

#include "emulator/contract/endpoint.h"
#include "emulator/devices/nortek-dvl/dvl.h"
#include "emulator/devices/nortek-dvl/models.h"

namespace echoloop::nortek_dvl {
namespace {

constexpr std::size_t most_listeners = 8;  // of a port of data; own choice

/// The first TCP port takes commands, the second says all data, the third those that are text; a serial line
/// does what the first does; datagrams go to any number of hosts.
class Wiring {
  public:
    Outlet outlet_of(const Endpoint& e) {
        using Scheme = Endpoint::Scheme;
        if (e.scheme == Scheme::udp) {
            constexpr std::uint32_t loopback = 0x7F000001;
            const Address from{is_loopback(e.ip) ? loopback : 0, e.local_port()};
            return {Speech::datagrams,
                    {numbered("datagrams", datagrams_), Port::Kind::datagram, from, false},
                    {e.ip, e.port}};
        }
        if (e.scheme == Scheme::tcp_listen && listeners_ < 3) return listener();
        if ((e.scheme == Scheme::pty || e.scheme == Scheme::serial) && lines_++ == 0)
            return {Speech::line, {"line", Port::Kind::stream, {}, false}, {}};
        throw std::invalid_argument(
            to_string(e) +
            ": a Nortek DVL has up to three TCP ports, for commands, for data and for data that are text, "
            "one serial "
            "line, and hosts of datagrams, e.g. [\"tcp-listen://127.0.0.1:9000\", "
            "\"tcp-listen://127.0.0.1:9002\", "
            "\"tcp-listen://127.0.0.1:9004\", \"pty:/tmp/echoloop/nortek-dvl\", \"udp://127.0.0.1:9005\"]");
    }

  private:
    Outlet listener() {
        constexpr const char* names[] = {"commands", "data", "text"};
        constexpr Speech speeches[] = {Speech::commands, Speech::data, Speech::text};
        Outlet out{speeches[listeners_], {names[listeners_], Port::Kind::stream, {}, false}, {}};
        if (listeners_++ > 0) {
            out.port.drivers = most_listeners;
            out.port.messages_kept = 64;
        }
        return out;
    }
    static std::string numbered(const std::string& name, std::size_t& count) {
        return ++count == 1 ? name : name + ' ' + std::to_string(count);
    }

    std::size_t listeners_ = 0, lines_ = 0, datagrams_ = 0;
};

struct Product {
    const char* name;
};
constexpr Product dvl500{"DVL500"}, dvl1000{"DVL1000"};

template <const Product* product>
std::unique_ptr<Device> make(const DeviceConfig& config) {
    if (config.endpoints.empty()) throw std::invalid_argument("a Nortek DVL has at least one endpoint");
    Wiring wiring;
    std::vector<Outlet> outlets;
    for (const Endpoint& e : config.endpoints) outlets.push_back(wiring.outlet_of(e));
    return std::make_unique<Dvl>(read_settings(config, product->name), std::move(outlets));
}

/// In the first mode whose depths reach out to `range`.
Shot default_shot(const DeviceConfig& config, std::size_t step, double range) {
    constexpr double usual = 20;  // m
    const Settings settings = read_settings(config, "");
    const doppler::Acoustics& a = settings.acoustics;
    const auto modes = doppler::usual_modes(a.lowest_altitude, a.highest_altitude);
    std::size_t mode = 0;
    while (mode + 1 < modes.size() && modes[mode].farthest < (range > 0 ? range : usual)) ++mode;
    return doppler::make_shot(doppler::make_plan(modes[mode], config.sound_speed, settings), settings,
                              step + 1);
}

std::vector<KnownDriver> drivers() {
    return {{"ros2",
             "BorgesJVT nortek_dvl_driver",
             {"ros2 run nortek_dvl_driver nortek_dvl_driver_node --ros-args -p ip_address:={host 2}"},
             "it has port 9002 by itself, and reads DF21",
             "tcp-listen"},
            {"ros1",
             "GSO-soslab nortek_dvl_ethernet",
             {"<param name=\"type\" value=\"UDP\"/>", "<param name=\"udp_rx\" value=\"{number}\"/>"},
             "into its nortekdvl1000.launch; it reads DF21 in datagrams",
             "udp"},
            {"ros1",
             "GSO-soslab nortek_dvl",
             {"<param name=\"port_name\" value=\"{port}\"/>"},
             "into its start_dvl.launch; it reads lines: bottom_format: bt7"},
            {"python",
             "pynmea2",
             {"import pynmea2, serial", "for line in serial.Serial('{port}', {rate}):",
              "    print(repr(pynmea2.parse(line.decode())))"},
             "it reads lines without tags, such as those of bottom_format: bt9"}};
}

Model row(const std::string& name, const std::string& title) {
    Model m;
    m.name = name;
    m.title = title;
    m.protocol =
        "Nortek's frames DF21 and DF22 or lines of text, and commands, TCP, UDP or serial 115200 8N1";
    m.default_endpoints = {"tcp-listen://127.0.0.1:9000"};
    m.endpoint_schemes = {"tcp-listen", "pty", "serial", "udp"};
    list_settings<Settings>(m);
    m.profile = built_in_profile(m.name);
    m.default_shot = default_shot;
    m.family = "nortek";
    m.drivers = drivers();
    return m;
}

}  // namespace

std::vector<Model> models() {
    std::vector<Model> all{row("nortek-dvl500", "Nortek DVL500 Doppler velocity log"),
                           row("nortek-dvl1000", "Nortek DVL1000 Doppler velocity log")};
    all[0].make = make<&dvl500>;
    all[1].make = make<&dvl1000>;
    return all;
}

}  // namespace echoloop::nortek_dvl
