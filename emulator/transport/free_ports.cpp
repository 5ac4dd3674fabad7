#include "emulator/transport/free_ports.h"

#include <algorithm>
#include <random>

#include "emulator/contract/random_key.h"

namespace echoloop {
namespace {

/// Above those that Linux gives by itself to whoever connects, and no sonar's usual ones. R2Sonic heads count
/// from theirs.
constexpr std::uint16_t lowest_number = 63000, numbers = 2000;

bool is_open_number(const Endpoint& endpoint) { return endpoint.listens() && endpoint.port == 0; }

}  // namespace

bool has_open_number(const std::vector<Endpoint>& endpoints) {
    return std::ranges::any_of(endpoints, is_open_number);
}

std::vector<Endpoint> with_numbers(std::vector<Endpoint> endpoints, std::string_view steady,
                                   unsigned attempt) {
    const std::uint64_t seed = steady.empty() ? std::random_device{}() : 0;
    for (std::size_t i = 0; i < endpoints.size(); ++i)
        if (is_open_number(endpoints[i]))
            endpoints[i].port = static_cast<std::uint16_t>(
                lowest_number + random_key(seed + attempt * endpoints.size() + i, steady) % numbers);
    return endpoints;
}

}  // namespace echoloop
