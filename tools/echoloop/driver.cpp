#include "tools/echoloop/driver.h"

#include "emulator/contract/endpoint.h"
#include "tools/echoloop/common.h"
#include "tools/echoloop/driver_port.h"
#include "tools/echoloop/driver_seanet.h"
#include "tools/echoloop/driver_vehicle.h"

namespace echoloop::cli {
namespace {

constexpr std::uint16_t image_offset = 3;
/// R2Sonic: what is sent where, counted from the host's base port.
struct Product {
    const char* name;
    std::uint16_t offset;
};
constexpr Product r2sonic_products[] = {{"bathymetry", 0},        {"TruePix", 1},      {"status", 2},
                                        {"images", image_offset}, {"water column", 5}, {"snippets", 6}};

bool is_r2sonic(const ScenarioDevice& device) { return device.model->name.starts_with("r2sonic-"); }
/// The heads that those drivers can read: the profiler is none of them.
bool is_seanet(const ScenarioDevice& device) {
    return device.model->name == "tritech-micron" || device.model->name == "tritech-seaking";
}

DriverHint r2sonic_ros2(const ScenarioDevice& device) {
    const Endpoint& head = device.config.endpoints.at(0);
    const Endpoint& host = device.config.endpoints.at(1);
    return {"USF-COMIT ros2sonic",
            {"ros2 run r2sonic r2sonic_node --ros-args -p interface_ip:=" + host.host +
             " -p ports/bathy:=" + std::to_string(host.port) + " -p ports/acoustic_image:=" +
             std::to_string(host.port + image_offset) + " -p sonar_ip:=" + head.host},
            "it only listens: settings come from the scenario, or from a program that sends CMD0"};
}

/// Where a device sends to that listens on no port of its own for it.
std::string told_host(const ScenarioDevice& device, const std::string& port) {
    if (device.model->name.starts_with("aris-") && port == "frames")
        return "the controller, or the receiver that it names";
    for (const Endpoint& end : device.config.endpoints)
        if (end.scheme == Endpoint::Scheme::udp) return address_text(end.host, end.port);
    return "whom it is told to by options or by its host";
}

std::string title_of(const std::string& format) {
    static const std::map<std::string, std::string> titles{{"ros1", "ROS 1"}, {"ros2", "ROS 2"},
                                                           {"moos", "MOOS"},  {"rock", "Rock"},
                                                           {"dune", "DUNE"},  {"sitl", "ArduPilot"}};
    return titles.at(format);
}

DriverHint no_driver(const ScenarioDevice& device, const std::string& format) {
    return {"", {}, "no driver of " + title_of(format) + " for " + device.model->name + " is known to us"};
}

}  // namespace

const std::vector<std::string>& driver_formats() {
    static const std::vector<std::string> formats{"ros1", "ros2", "moos", "rock", "dune", "sitl"};
    return formats;
}

std::string place_line(const WirePlace& place) { return padded(place.what, 32) + place.address; }

std::vector<WirePlace> wire_places(const ScenarioDevice& device) {
    std::vector<WirePlace> places;
    const Endpoint& first = device.config.endpoints.at(0);
    for (const Port& port : device.model->make(device.config)->ports()) {
        if (port.kind == Port::Kind::datagram && places.empty() && first.scheme == Endpoint::Scheme::udp) {
            places.push_back({"sends " + port.name + " to", address_text(first.host, first.port)});
        } else if (port.kind == Port::Kind::datagram && port.bind.port == 0) {
            places.push_back({"sends " + port.name + " to", told_host(device, port.name)});
        } else if (port.kind == Port::Kind::datagram) {
            places.push_back({"listens for " + port.name, text_of(port.bind)});
        } else {
            const Endpoint& end = device.config.endpoints.at(places.size());
            places.push_back({port.name, stream_address(end, chosen_rate(device))});
        }
    }
    if (device.model->name == "kongsberg-kmall") {
        places.push_back({"sends datagrams to", told_host(device, "")});
        for (std::size_t i = 2; i < device.config.endpoints.size(); ++i) {
            const Endpoint& host = device.config.endpoints[i];
            places.push_back({"sends texts to", address_text(host.host, host.port)});
        }
    }
    if (!is_r2sonic(device)) return places;
    const Endpoint& host = device.config.endpoints.at(1);
    for (const Product& product : r2sonic_products)
        places.push_back({std::string("sends ") + product.name + " to",
                          address_text(host.host, host.port + product.offset)});
    return places;
}

DriverHint driver_hint(const ScenarioDevice& device, const std::string& format) {
    if (is_r2sonic(device) && format == "ros2") return r2sonic_ros2(device);
    auto hint = is_seanet(device) ? seanet_driver_hint(device, format) : vehicle_driver_hint(device, format);
    return hint.driver.empty() && hint.note.empty() ? no_driver(device, format) : hint;
}

}  // namespace echoloop::cli
