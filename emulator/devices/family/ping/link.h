// What all devices of the Ping protocol do with bytes: frames per host, line breaks, replies under their own
// id. Knows no message of a particular device.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/contract/device.h"
#include "emulator/contract/host_lines.h"
#include "emulator/contract/settings_list.h"
#include "protocols/ping/codec.h"
#include "protocols/ping/framer.h"

namespace echoloop::ping_device {

using echoloop::Peer;

/// What one read holds.
struct Heard {
    bool line_break = false;  ///< it came before the frames
    std::vector<ping::Frame> frames;
};

/// A frame as datagrams of at most `piece` bytes; 0 leaves it whole.
std::vector<Send> in_pieces(wire::Bytes frame, const Peer& to, std::size_t piece);

class Link {
  public:
    /// `marks_are_breaks`: 0x55 where a frame should begin is the end of a line break, which a
    /// pseudo-terminal does not carry.
    Link(std::uint8_t id, bool marks_are_breaks);

    Heard receive(const Received& data);
    void reset(std::size_t port) { hosts_.clear(port); }
    /// A message of any codec on this framing, which encode(message, source) of its own namespace turns into
    /// a frame.
    template <class Message>
    Send reply(const Message& message, const Peer& to) const {
        return {to.port, encode(message, id_), to.address, {}};
    }
    /// A frame of this id without a payload.
    Send reply_without_content(ping::Id id, const Peer& to) const;
    /// As above for what may not fit one datagram: each message begins one, longer ones go on in further
    /// datagrams of at most `piece` bytes. On a byte stream, `piece` 0, it stays whole.
    template <class Message>
    std::vector<Send> reply_in_pieces(const Message& message, const Peer& to, std::size_t piece) const {
        return in_pieces(encode(message, id_), to, piece);
    }
    std::uint64_t skipped_bytes() const { return hosts_.skipped_bytes(); }
    void set_id(std::uint8_t id) { id_ = id; }
    std::uint8_t id() const { return id_; }

  private:
    HostLines<ping::Framer> hosts_;
    std::uint8_t id_;
    bool marks_are_breaks_;
};

/// A port per endpoint. std::invalid_argument if there are none, more than four, or datagrams with a line
/// rate.
std::vector<Port> link_ports(const std::vector<Endpoint>& endpoints, double baud);

/// "3.3.8" as three numbers of 0..255; std::invalid_argument naming `option` otherwise.
std::array<std::uint8_t, 3> read_version(const std::string& text, const std::string& option);
ping::Nack nack(ping::Id refused, std::string_view text);
/// Lists an option that is a version: three numbers of 0 to 255, like 3.3.8. std::invalid_argument otherwise.
void version(std::array<std::uint8_t, 3>& member, OptionList& options, std::string_view name,
             std::string_view help, std::string_view source);

}  // namespace echoloop::ping_device
