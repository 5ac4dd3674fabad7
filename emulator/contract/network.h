// A network of IPv4 addresses, as a scenario names it. Parses and prints.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace echoloop {

struct Network {
    std::uint32_t ip = 0;  ///< host byte order; what lies behind the prefix is 0
    int bits = 32;         ///< of the prefix

    bool holds(std::uint32_t address) const { return ((address ^ ip) & mask(bits)) == 0; }
    static constexpr std::uint32_t mask(int bits) { return bits == 0 ? 0 : ~0U << (32 - bits); }
    friend bool operator==(const Network&, const Network&) = default;
};

/// "192.168.2.0/24", or one address. Throws std::invalid_argument with a sentence for the user.
Network parse_network(std::string_view text);
std::string to_string(const Network& network);

}  // namespace echoloop
