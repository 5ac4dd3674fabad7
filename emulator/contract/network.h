// Addresses of IPv4, in host byte order, and networks of them, as a scenario names them. Parses and prints.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace echoloop {

/// A whole number in decimal digits alone, up to `maximum`.
std::optional<std::uint32_t> decimal(std::string_view text, std::uint32_t maximum);
/// "127.0.0.1"; empty if it is no address.
std::optional<std::uint32_t> parse_ipv4(std::string_view text);
std::string ipv4_text(std::uint32_t ip);

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
