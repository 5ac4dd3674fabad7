// Datagrams on one local address. Never connected: a refusal by the other side must not end the emulation.
// What is bound to loopback sends to loopback only, and to multicast groups, which stay there.
#pragma once

#include "emulator/transport/transport.h"

namespace echoloop {

class Udp final : public CountingTransport {
  public:
    /// `shared`: other programs may listen on the same address (discovery). `reply_to`: where write() sends
    /// when it is given no address; until somebody has spoken, `reply_to.port` may be 0 and the bytes are
    /// lost. Throws StartError if the address cannot be bound.
    Udp(asio::io_context& io, Address bind, bool shared, Address reply_to = {});
    ~Udp() override { close(); }

    void start(Events events) override;
    Task<void> write(ByteView bytes, Address to) override;
    void close() override;
    std::string describe() const override;
    Wire wire() const override;

  private:
    Task<void> read_datagrams();
    bool may_send_to(std::uint32_t ip) const;

    asio::ip::udp::socket socket_;
    Address reply_to_;
    Events events_;
};

}  // namespace echoloop
