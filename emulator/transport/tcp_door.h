// Where drivers knock: one listening TCP port, and the lines that it gives them to. It reads and writes
// nothing.
#pragma once

#include <string>
#include <vector>

#include "emulator/asio.h"
#include "emulator/device.h"

namespace echoloop {

class TcpListener;

class TcpDoor {
  public:
    /// Throws StartError if the address cannot be bound.
    TcpDoor(asio::io_context& io, Address bind);

    /// `line` gets a driver whenever it has none, the line added first before all others; until remove().
    void add(TcpListener& line) { lines_.push_back(&line); }
    void remove(TcpListener& line);
    bool serves_several() const { return lines_.size() > 1; }

    /// Drivers are let in from now on.
    void begin();
    /// The cable is pulled, and put back. An address that cannot be had again is logged.
    void shut();
    void open();
    void close();
    bool is_open() const { return acceptor_.is_open(); }
    asio::io_context& io() const { return io_; }
    /// Zero while it is not open.
    Address address() const;
    /// "tcp-listen://127.0.0.1:9090".
    std::string describe() const;

  private:
    Task<void> let_in();
    /// nullptr if all are taken.
    TcpListener* free_line() const;

    asio::io_context& io_;
    asio::ip::tcp::acceptor acceptor_;
    std::vector<TcpListener*> lines_;
    Address shut_;  ///< where it listened; port 0: it is not shut
    bool begun_ = false;
};

}  // namespace echoloop
