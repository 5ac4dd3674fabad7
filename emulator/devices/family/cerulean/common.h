// What all Cerulean sonars do alike beside their own messages: who they say they are, how they are
// discovered, how long messages travel. Knows no message of a particular device.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "emulator/contract/settings_list.h"
#include "emulator/devices/family/ping/link.h"
#include "emulator/devices/family/ping/serial_rate.h"

namespace echoloop::cerulean_device {

/// Options that all of them have.
struct Identity {
    int listed_type = 0;  ///< what the maker's list of device types says
    std::uint8_t device_type = 198, device_revision = 1;
    std::array<std::uint8_t, 3> firmware{1, 0, 0}, protocol{1, 0, 0};
    std::uint8_t source = 0;   ///< in the header of what the device sends
    bool acknowledge = false;  ///< ack what sets something
    bool nack_requested_id = false;
    std::size_t datagram = 1472;  ///< bytes, at most
    double baud = 0;              ///< bit/s, of ptys and TCP; 0: not paced
    SerialRate line{};
    std::string discovery{};       ///< address to announce; empty: not discoverable
    std::string discovery_name{};  ///< first line of the announcement
};

/// std::invalid_argument if a version is none.
void describe(Identity& identity, OptionList& options);

ping::DeviceInformation device_information(const Identity& identity);
ping::ProtocolVersion protocol_version(const Identity& identity);
/// Id of the nack for a request that is refused.
ping::Id refused_id(const Identity& identity, ping::Id requested);

/// Whether a host's speed of sound, in mm/s, can be one; some hosts send m/s.
bool is_speed_of_sound(std::uint32_t speed);

/// The ports of a device: one per endpoint, and one for discovery if it is wanted. std::invalid_argument as
/// link_ports, or if the address to announce is none.
std::vector<Port> make_ports(const std::vector<Endpoint>& endpoints, const Identity& identity);
/// Per port, what reply_in_pieces wants: the largest datagram, or 0 for a byte stream.
std::vector<std::size_t> pieces(const std::vector<Endpoint>& endpoints, const Identity& identity);
/// The announcement, with the data port of the first endpoint that has one; empty for any other bytes than
/// the question.
wire::Bytes discovery_reply(wire::ByteView question, const std::vector<Endpoint>& endpoints,
                            const Identity& identity);

}  // namespace echoloop::cerulean_device
