#include <stdexcept>

#include "emulator/devices/kongsberg-kmall/kongsberg.h"
#include "emulator/endpoint.h"

namespace echoloop::kongsberg_kmall {
namespace {

Address address_of(const std::string& uri, Endpoint::Scheme scheme, const char* what) {
    const Endpoint endpoint = parse_endpoint(uri);
    if (endpoint.scheme != scheme)
        throw std::invalid_argument(uri + ": " + what + " must be " + std::string(scheme_name(scheme)) +
                                    "://ADDRESS:PORT");
    return {endpoint.ip, endpoint.port};
}

Wiring read_wiring(const std::vector<std::string>& endpoints) {
    if (endpoints.size() != 2)
        throw std::invalid_argument(
            "a Kongsberg multibeam has two endpoints, where commands arrive and where datagrams go, e.g. "
            "[\"udp-listen://127.0.0.1:14002\", \"udp://127.0.0.1:6020\"]");
    Wiring wiring{address_of(endpoints[0], Endpoint::Scheme::udp_listen, "the endpoint for commands"),
                  address_of(endpoints[1], Endpoint::Scheme::udp, "the endpoint of datagrams")};
    if (wiring.own.ip >> 24 == 127 && wiring.host.ip >> 24 != 127)
        throw std::invalid_argument(
            endpoints[1] +
            ": a sounder on a loopback address sends to loopback only; give the first "
            "endpoint an address of that network");
    return wiring;
}

std::unique_ptr<Device> make(const DeviceConfig& config) {
    return std::make_unique<Kongsberg>(read_settings(config), read_wiring(config.endpoints));
}

Shot default_shot(const DeviceConfig& config, std::size_t step, double range) {
    Settings settings = read_settings(config);
    if (range > 0) settings.range = range;
    return make_shot(settings, step + 1);
}

}  // namespace

Model model() {
    Model m;
    m.name = "kongsberg-kmall";
    m.title = "Kongsberg EM multibeam echosounder, KMALL";
    m.protocol = "KMALL over UDP: #MRZ, #MWC, start and stop";
    m.default_endpoints = {"udp-listen://127.0.0.1:14002", "udp://127.0.0.1:6020"};
    m.endpoint_schemes = {"udp-listen"};
    m.options = option_table();
    m.figures = figure_table();
    m.profile = built_in_profile(m.name);
    m.make = make;
    m.default_shot = default_shot;
    return m;
}

}  // namespace echoloop::kongsberg_kmall
