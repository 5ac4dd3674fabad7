// A byte stream over TCP: a listener that serves one driver at a time (as a serial bridge does), or a client
// that keeps trying to reach one.
#pragma once

#include <memory>
#include <vector>

#include "emulator/transport/transport.h"

namespace echoloop {

class TcpListener final : public CountingTransport {
  public:
    /// Throws StartError if the address cannot be bound.
    TcpListener(asio::io_context& io, Address bind);
    ~TcpListener() override { close(); }

    void start(Events events) override;
    Task<void> write(ByteView bytes, Address to) override;
    void hang_up() override;
    bool has_driver() const override { return driver_ != nullptr; }
    void unplug() override;
    void plug() override;
    void reset() override;
    void forget() override;
    void reset_forgotten() override;
    void close() override;
    std::string describe() const override;
    Wire wire() const override;

  private:
    Task<void> accept_drivers();
    Task<void> serve(std::shared_ptr<asio::ip::tcp::socket> driver);

    asio::ip::tcp::acceptor acceptor_;
    std::shared_ptr<asio::ip::tcp::socket> driver_;  ///< a writer may still hold the one that has gone
    std::vector<std::shared_ptr<asio::ip::tcp::socket>> forgotten_;
    Address unplugged_;  ///< where it listened; port 0: it is plugged in
    Events events_;
};

class TcpClient final : public CountingTransport {
  public:
    TcpClient(asio::io_context& io, std::string host, std::uint16_t port);
    ~TcpClient() override { close(); }

    void start(Events events) override;
    Task<void> write(ByteView bytes, Address to) override;
    void hang_up() override;
    bool has_driver() const override { return connected_; }
    void unplug() override;
    void plug() override;
    void reset() override;
    void forget() override;
    void reset_forgotten() override;
    void close() override;
    std::string describe() const override;
    Wire wire() const override;

  private:
    Task<void> keep_connected();
    Task<void> read_stream();

    asio::ip::tcp::socket socket_;
    asio::steady_timer retry_;
    std::string host_;
    std::uint16_t port_;
    bool closing_ = false;
    bool connected_ = false;
    bool unplugged_ = false, forgetting_ = false;
    std::vector<asio::ip::tcp::socket> forgotten_;
    Events events_;
};

}  // namespace echoloop
