#include <algorithm>
#include <stdexcept>

#include "emulator/contract/endpoint.h"
#include "emulator/devices/aris/aris.h"

namespace echoloop::aris_device {
namespace {

constexpr std::uint16_t beacon_udp_port = 56124;
constexpr std::uint32_t loopback_broadcast = 0x7FFFFFFF;  // 127.255.255.255
constexpr Variant aris_1200{aris::system_type::aris1200, 1, 1};
constexpr Variant aris_1800{aris::system_type::aris1800, 3, 1};
constexpr Variant aris_3000{aris::system_type::aris3000, 9, 6};

void check_listener(const Endpoint& listener) {
    if (listener.scheme != Endpoint::Scheme::tcp_listen)
        throw std::invalid_argument(to_string(listener) +
                                    ": the first endpoint must be tcp-listen://ADDRESS:56888");
    if (listener.ip == 0)
        throw std::invalid_argument(
            to_string(listener) +
            ": controllers connect to the address that beacons come from; name one of this machine's");
}

Address read_beacon(const Endpoint& beacon) {
    if (beacon.scheme != Endpoint::Scheme::udp)
        throw std::invalid_argument(to_string(beacon) +
                                    ": the second endpoint, for the beacon, must be udp://ADDRESS:56124");
    return {beacon.ip, beacon.port};
}

Wiring read_wiring(const std::vector<Endpoint>& endpoints) {
    if (endpoints.empty() || endpoints.size() > 2)
        throw std::invalid_argument(
            "an ARIS has one or two endpoints, its command port and where its beacon goes, e.g. "
            "[\"tcp-listen://192.168.1.4:56888\", \"udp://192.168.1.255:56124\"]");
    const Endpoint& listener = endpoints[0];
    check_listener(listener);
    if (endpoints.size() == 1 && !is_loopback(listener.ip))
        throw std::invalid_argument(to_string(listener) +
                                    ": say where the beacon goes, e.g. \"udp://192.168.1.255:56124\"");
    Wiring wiring{{listener.ip, listener.port}, {loopback_broadcast, beacon_udp_port}};
    if (endpoints.size() == 2) wiring.beacon = read_beacon(endpoints[1]);
    return wiring;
}

template <const Variant& variant>
std::unique_ptr<Device> make(const DeviceConfig& config) {
    return std::make_unique<Aris>(read_settings(config, variant), read_wiring(config.endpoints));
}

/// The example of the notes for the model: 4 to 24 m, 1.5 to 7.5 m, or 1.5 to 5 m.
aris::SetAcoustics example(const Variant& variant) {
    switch (variant.system_type) {
        case aris::system_type::aris1200:
            return {1, 10, 1082, 5408, 32818, 25, 24, 1, true, 1, true, 20};
        case aris::system_type::aris3000:
            return {1, 15, 946, 2028, 7118, 5, 10, 9, true, 1, true, 12};
        default:
            return {1, 15, 1014, 2028, 10500, 8, 11, 3, true, 1, true, 18};
    }
}

/// `range` is reached by longer sample periods.
template <const Variant& variant>
Shot default_shot(const DeviceConfig& config, std::size_t step, double range) {
    aris::SetAcoustics a = example(variant);
    if (range > 0) {
        const double heard = 2e6 * range / config.sound_speed - a.start_delay;
        a.sample_period = static_cast<std::uint32_t>(std::clamp(heard / a.samples, 4.0, 100.0) + 0.5);
        a.cycle_period = a.start_delay + a.sample_period * a.samples + 360;
        a.frame_rate = std::min(a.frame_rate, static_cast<float>(1 / frame_time(a)));
    }
    return make_shot(a, false, read_settings(config, variant), step + 1);
}

template <const Variant& variant>
Model row(const std::string& name, const std::string& title) {
    Model m;
    m.name = name;
    m.title = title;
    m.protocol = "ARIS: beacon and frames on UDP, commands on TCP";
    m.default_endpoints = {"tcp-listen://127.0.0.1:56888", "udp://127.255.255.255:56124"};
    m.endpoint_schemes = {"tcp-listen"};
    list_settings<Settings>(m);
    m.profile = built_in_profile(m.name);
    m.make = make<variant>;
    m.default_shot = default_shot<variant>;
    m.family = "aris";
    m.sends = {{.what = "frames", .words = "the controller, or the receiver that it names"}};
    m.drivers = {{"maker",
                  "Sound Metrics' sample program connect-command (ARIS Integration SDK, MIT)",
                  {"./connect {serial}"},
                  "it finds the sonar by the beacon on UDP 56124 and takes frames for half a minute; it is "
                  "written for "
                  "protobuf-c's code of proto2: give the SDK's .proto files optional fields, and the type of "
                  "a command "
                  "required; no driver of a framework is public"}};
    return m;
}

}  // namespace

std::vector<Model> models() {
    return {row<aris_1200>("aris-1200", "Sound Metrics ARIS 1200 imaging sonar"),
            row<aris_1800>("aris-1800", "Sound Metrics ARIS 1800 imaging sonar"),
            row<aris_3000>("aris-3000", "Sound Metrics ARIS 3000 imaging sonar")};
}

}  // namespace echoloop::aris_device
