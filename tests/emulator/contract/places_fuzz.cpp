// libFuzzer: any text as the names of places: endpoints, networks, addresses, the control place. What is
// taken is printed and read again as the same; what is refused gets a sentence.
#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <stdexcept>

#include "emulator/contract/endpoint.h"
#include "emulator/contract/network.h"
#include "emulator/scenario/control_place.h"

using namespace echoloop;

namespace {

void require(bool good) {
    if (!good) std::abort();
}

void read(std::string_view text, const auto& parse) {
    try {
        parse(text);
    } catch (const std::invalid_argument& error) {
        require(error.what()[0] != '\0');
    }
}

void endpoint(std::string_view text) {
    const Endpoint endpoint = parse_endpoint(text);
    require(parse_endpoint(to_string(endpoint)) == endpoint);
    require(clash(endpoint, endpoint) == clash(endpoint, parse_endpoint(to_string(endpoint))));
    endpoint.local_port();
    endpoint.checks_baud();
    endpoint.usb_latency();
    endpoint.group();
    if (const auto idle = endpoint.idle()) require(*idle >= 0);
    line_rate(std::span(&endpoint, 1), 0);
}

void network(std::string_view text) {
    const Network network = parse_network(text);
    require(parse_network(to_string(network)) == network && network.holds(network.ip));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    read(text, endpoint);
    read(text, network);
    read(text, [](std::string_view place) { parse_control_place(place); });
    if (const auto ip = parse_ipv4(text)) require(parse_ipv4(ipv4_text(*ip)) == ip);
    return 0;
}
