// A byte stream over TCP: the line of a driver that comes by a door (one at a time, as a serial bridge serves
// them), or a client that keeps trying to reach one.
#pragma once

#include <memory>
#include <vector>

#include "emulator/transport/tcp_door.h"
#include "emulator/transport/transport.h"

namespace echoloop {

/// The line of one driver at a time.
class TcpListener final : public CountingTransport {
  public:
    /// The only line behind a door of its own. Throws StartError if the address cannot be bound.
    TcpListener(asio::io_context& io, Address bind) : TcpListener(std::make_shared<TcpDoor>(io, bind)) {}
    /// One of several lines behind `door`: each has a driver of its own.
    explicit TcpListener(std::shared_ptr<TcpDoor> door);
    ~TcpListener() override;

    /// From the door: somebody has come; only while nobody is here.
    void take(asio::ip::tcp::socket driver);
    /// From the door: another is to have the place. It is free afterwards.
    Task<void> let_go();
    /// s since the driver last said or took something.
    double idle_time() const { return to_seconds(std::chrono::steady_clock::now() - lively_); }

    void start(Events events) override;
    Task<void> write(ByteView bytes, Address to) override;
    void hang_up(Address to) override;
    bool has_driver() const override { return driver_ != nullptr; }
    void unplug() override;
    void plug() override { door_->open(); }
    void reset() override;
    void forget() override;
    void reset_forgotten() override;
    void close() override;
    std::string describe() const override { return door_->describe(); }
    Wire wire() const override;
    std::vector<std::string> connected() const override;

  private:
    Task<void> serve(std::shared_ptr<asio::ip::tcp::socket> driver, Address peer);
    Task<void> wait_for_last_answer();

    std::shared_ptr<TcpDoor> door_;
    asio::steady_timer last_answer_;                 ///< to one that has closed its direction
    std::shared_ptr<asio::ip::tcp::socket> driver_;  ///< a writer may still hold the one that has gone
    std::vector<std::shared_ptr<asio::ip::tcp::socket>> forgotten_;
    std::chrono::steady_clock::time_point lively_{};  ///< when the driver last said or took something
    bool hung_up_ = false;                            ///< on this driver
    bool closed_ = false;
    Events events_;
};

class TcpClient final : public CountingTransport {
  public:
    TcpClient(asio::io_context& io, std::string host, std::uint16_t port);
    ~TcpClient() override { close(); }

    void start(Events events) override;
    Task<void> write(ByteView bytes, Address to) override;
    void hang_up(Address to) override;
    bool has_driver() const override { return connected_; }
    void unplug() override;
    void plug() override;
    void reset() override;
    void forget() override;
    void reset_forgotten() override;
    void close() override;
    std::string describe() const override;
    Wire wire() const override;
    std::vector<std::string> connected() const override;

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
