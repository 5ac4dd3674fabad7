// Datagrams on one local address. Never connected: a refusal by the other side must not end the emulation.
// It sends to its peers only, to multicast groups, and to all of its network by 255.255.255.255.
#pragma once

#include "emulator/transport/peers.h"
#include "emulator/transport/transport.h"

namespace echoloop {

class Udp final : public CountingTransport {
  public:
    /// `shared`: other programs may listen on the same address (discovery); where one has it for itself, the
    /// log says so and nothing is heard or sent there. `reply_to`: where write() sends when it is given no
    /// address; until somebody has spoken, `reply_to.port` may be 0 and the bytes are lost. Throws StartError
    /// if another address cannot be bound.
    Udp(asio::io_context& io, Address bind, bool shared, Peers peers, Address reply_to = {});
    ~Udp() override { close(); }

    void start(Events events) override;
    Task<void> write(ByteView bytes, Address to) override;
    void close() override;
    std::string describe() const override;
    Wire wire() const override;
    std::string open_to() const override { return peers_.describe(); }
    std::uint64_t targets_refused() const override { return refused_; }

  private:
    Task<void> read_datagrams();
    bool may_send_to(std::uint32_t ip) const;
    Address local() const;

    asio::ip::udp::socket socket_;
    Address bind_;
    Peers peers_;
    Address reply_to_;
    std::uint64_t refused_ = 0;  ///< datagrams
    Events events_;
};

}  // namespace echoloop
