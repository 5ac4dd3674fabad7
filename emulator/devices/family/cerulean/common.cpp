#include "emulator/devices/family/cerulean/common.h"

#include <string_view>
#include <utility>

namespace echoloop::cerulean_device {
namespace {

constexpr std::uint16_t discovery_port = 30303;
const char* const spec = "Ping specification notes";

/// Where hosts find the data: the first port that is listened on.
std::uint16_t data_port(const std::vector<Endpoint>& endpoints) {
    for (const Endpoint& e : endpoints)
        if (e.listens()) return e.port;
    return 0;
}

}  // namespace

void describe(Identity& i, OptionList& o) {
    ping_device::version(
        i.firmware, o, "firmware",
        "version in device_information; what versions differ in is not public: only the number changes",
        "own choice: hosts do not look at it");
    ping_device::version(i.protocol, o, "protocol_version", "version of the message set", spec);
    o.whole(i.device_type, "device_type", "", 0, 255,
            "in device_information; " + std::to_string(i.listed_type) + " in the maker's list of types",
            spec);
    o.whole(i.device_revision, "device_revision", "", 0, 255, "in device_information", spec);
    o.whole(i.source, "source_id", "", 0, 255, "source in the header of what the device sends",
            "maker's manual: reserved, 0");
    o.flag(i.acknowledge, "acknowledge", "ack messages that set something",
           "own choice: the manual names no ack for them, and each delays some public hosts by a ping");
    o.choice(i.nack_requested_id, "nacked_id", {"request", "requested"},
             "id in the nack of a general_request: 6, or the id that was asked for", spec);
    o.whole(i.datagram, "datagram", "B", 64, 65507,
            "largest datagram; longer messages continue in the next one. Public hosts hang on one of exactly "
            "4096",
            "Ethernet frame of 1500 bytes less the headers of IP and UDP");
    describe(i.baud, i.line, o);
    o.text(i.discovery, "discovery",
           "IPv4 address to announce on UDP 30303 of that interface; empty or off: silent", spec);
    o.text(i.discovery_name, "discovery_name", "first line of the announcement",
           "own choice after the maker's other sonars; their real line is not public");
}

ping::DeviceInformation device_information(const Identity& i) {
    return {i.device_type, i.device_revision, i.firmware[0], i.firmware[1], i.firmware[2], 0};
}

ping::ProtocolVersion protocol_version(const Identity& i) {
    return {i.protocol[0], i.protocol[1], i.protocol[2], 0};
}

ping::Id refused_id(const Identity& identity, ping::Id requested) {
    return identity.nack_requested_id ? requested : ping::Id::general_request;
}

bool is_speed_of_sound(std::uint32_t speed) {
    constexpr std::uint32_t lowest = 1000000, highest = 2000000;  // mm/s
    return speed >= lowest && speed <= highest;
}

std::vector<Port> make_ports(const std::vector<Endpoint>& endpoints, const Identity& identity) {
    std::vector<Port> ports = ping_device::link_ports(endpoints, identity.baud);
    if (!identity.discovery.empty() && identity.discovery != "off") {
        const Endpoint at =
            parse_endpoint("udp-listen://" + identity.discovery + ":" + std::to_string(discovery_port));
        ports.push_back({"discovery", Port::Kind::datagram, {at.ip, at.port}, true});
    }
    return ports;
}

std::vector<std::size_t> pieces(const std::vector<Endpoint>& endpoints, const Identity& identity) {
    std::vector<std::size_t> all;
    for (const Endpoint& e : endpoints) all.push_back(e.on_udp() ? identity.datagram : 0);
    return all;
}

wire::Bytes discovery_reply(wire::ByteView question, const std::vector<Endpoint>& endpoints,
                            const Identity& identity) {
    const std::string_view asked(reinterpret_cast<const char*>(question.data()), question.size());
    if (!asked.starts_with("Discovery")) return {};
    const std::string words =
        identity.discovery_name + "\r\nCerulean Sonar\r\nMAC Address:- 54-10-EC-00-00-02\r\n" +
        "IP Address:- " + identity.discovery + "\r\nPort:- " + std::to_string(data_port(endpoints)) + "\r\n";
    return {words.begin(), words.end()};
}

}  // namespace echoloop::cerulean_device
