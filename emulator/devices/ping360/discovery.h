// What an Ethernet Ping360 says of itself on UDP 30303. Text in, text out; opens nothing.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/contract/device.h"

namespace echoloop::ping360 {

/// Hosts find the sonar here and then talk to UDP 12345 of the address that they were told.
inline constexpr std::uint16_t discovery_port = 30303, found_port = 12345;

/// An IPv4 address in host byte order from "192.168.2.3", octets also padded with zeros; nothing if it is
/// none.
std::optional<std::uint32_t> read_address(std::string_view text);

class Discovery {
  public:
    /// Tells of `address`; 0: silent.
    explicit Discovery(std::uint32_t address) : own_(address), told_(address) {}

    /// Where it listens: a loopback address also hears loopback's broadcasts, any other listens everywhere,
    /// since broadcasts come to no address of their own.
    std::vector<Port> ports() const;
    /// The reply to "Discovery". "SetSS1IP 192.168.002.003" changes the address that is told from then on,
    /// without a reply; zeros stand for DHCP, which is the own address here. Nothing for all else.
    std::optional<std::string> hear(std::string_view text);

  private:
    std::uint32_t own_, told_;
};

}  // namespace echoloop::ping360
