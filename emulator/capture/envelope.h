// The headers that bytes would have had on a real wire, so that packet tools understand a capture of what
// only ever was a pseudo-terminal or a socket. Pure functions of bytes and addresses, and the sequence
// numbers of one TCP connection.
#pragma once

#include <vector>

#include "emulator/capture/pcapng.h"
#include "emulator/contract/device.h"

namespace echoloop {

/// From where to where.
struct Route {
    Address from, to;
};

/// LINKTYPE_RTAC_SERIAL: time in seconds and microseconds, event (1 sent, 2 received), modem lines, all big
/// endian.
Bytes rtac_serial_packet(ByteView bytes, pcapng::WallTime time, pcapng::Direction direction);

/// IPv4 and UDP; the UDP checksum is 0, which means none. At most 65507 bytes of payload, what is more is
/// cut.
Bytes udp_packet(ByteView payload, const Route& route);

/// One TCP connection between a device and its driver.
class TcpConversation {
  public:
    /// `driver_began`: the driver connected to the device, not the other way round.
    TcpConversation(Address device, Address driver, bool driver_began);

    struct Segment {
        Bytes packet;  ///< IPv4, TCP, payload
        pcapng::Direction direction;
    };
    /// SYN, SYN+ACK, ACK.
    std::vector<Segment> opening();
    /// What does not fit one packet becomes several.
    std::vector<Segment> data(ByteView payload, pcapng::Direction direction);

  private:
    Segment segment(pcapng::Direction direction, std::uint8_t flags, ByteView payload);

    Address device_, driver_;
    bool driver_began_;
    std::uint32_t sent_ = 1, received_ = 1;  ///< next sequence numbers of device and driver
};

}  // namespace echoloop
