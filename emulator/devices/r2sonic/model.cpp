#include <stdexcept>

#include "emulator/contract/endpoint.h"
#include "emulator/devices/r2sonic/r2sonic.h"

namespace echoloop::r2sonic_device {
namespace {

constexpr std::size_t most_endpoints = first_input + input_count;

Address base_address(const Endpoint& endpoint, Endpoint::Scheme scheme, const char* what) {
    if (endpoint.scheme != scheme)
        throw std::invalid_argument(to_string(endpoint) + ": " + what + " must be " +
                                    std::string(scheme_name(scheme)) + "://ADDRESS:BASE_PORT");
    if (endpoint.port > highest_base_port)
        throw std::invalid_argument(to_string(endpoint) +
                                    ": the base port is 65528 at most, since R2Sonic counts from it");
    return {endpoint.ip, endpoint.port};
}

Wiring read_wiring(const std::vector<Endpoint>& endpoints) {
    if (endpoints.size() < 2 || endpoints.size() > most_endpoints)
        throw std::invalid_argument(
            "an r2sonic head needs two endpoints, its own and the host's base port, e.g. "
            "[\"udp-listen://127.0.0.1:65500\", \"udp://127.0.0.1:65400\"]; a third, udp-listen, adds a SIM, "
            "and up to three "
            "more its motion sensor, GPS receiver and sound velocity probe");
    Wiring wiring;
    wiring.head = base_address(endpoints[0], Endpoint::Scheme::udp_listen, "the head's own endpoint");
    wiring.gui = base_address(endpoints[1], Endpoint::Scheme::udp, "the host's endpoint");
    if (endpoints.size() > 2)
        wiring.sim = base_address(endpoints[2], Endpoint::Scheme::udp_listen, "the SIM's endpoint");
    for (std::size_t i = first_input; i < endpoints.size(); ++i)
        if (endpoints[i].scheme == Endpoint::Scheme::udp)
            throw std::invalid_argument(to_string(endpoints[i]) +
                                        ": an input of the SIM hears, e.g. at udp-listen://127.0.0.1:5001 or "
                                        "pty:/tmp/echoloop/motion");
    wiring.all = endpoints;
    return wiring;
}

/// A model's functions hold no state, so each of the series has its own, by its place in variants().
template <std::size_t Index>
std::unique_ptr<Device> make(const DeviceConfig& config) {
    return std::make_unique<R2Sonic>(read_settings(config, variants()[Index]), read_wiring(config.endpoints));
}

template <std::size_t Index>
Shot default_shot(const DeviceConfig& config, std::size_t step, double range) {
    Settings settings = read_settings(config, variants()[Index]);
    if (range > 0) settings.start.range = range;
    const auto number = static_cast<std::uint32_t>(step + 1);
    return make_shot(settings.start, settings, beam_angles(settings.start, 0, 0), 0, number);
}

/// Its parameters as its newest version declares them; older ones write ports/bathy and know no sim_ip.
KnownDriver ros2sonic(const std::string& sim) {
    return {
        "ros2",
        "USF-COMIT ros2sonic",
        {"ros2 run r2sonic r2sonic_node --ros-args -p interface_ip:={host 2} -p ports.bathy:={bathymetry} "
         "-p ports.acoustic_image:={images} -p sonar_ip:={host} -p sim_ip:=" +
         sim},
        "each second it sends its settings to UDP 65502 of head and SIM, so give the head the base port "
        "65500, and it looks for sonars by a broadcast in 10.0.0.0/8"};
}

template <std::size_t Index>
Model model() {
    const Variant& variant = variants()[Index];
    Model m;
    m.name = variant.name;
    m.title = variant.title;
    m.protocol = "R2Sonic UDP: BTH0, AID0, WCD0, SNI0, TPX0, status, commands, discovery";
    m.default_endpoints = {"udp-listen://127.0.0.1:65500", "udp://127.0.0.1:65400"};
    m.endpoint_schemes = {"udp-listen"};
    list_settings<Settings>(m, variant);
    m.profile = built_in_profile(m.name);
    m.make = make<Index>;
    m.default_shot = default_shot<Index>;
    m.family = "r2sonic";
    m.sends = {{"bathymetry", 1, 0}, {"TruePix", 1, 1},      {"status", 1, 2},
               {"images", 1, 3},     {"water column", 1, 5}, {"snippets", 1, 6}};
    m.drivers = {ros2sonic("{host 3}"), ros2sonic("{host}")};
    return m;
}

}  // namespace

std::vector<Model> models() { return {model<0>(), model<1>(), model<2>(), model<3>()}; }

}  // namespace echoloop::r2sonic_device
