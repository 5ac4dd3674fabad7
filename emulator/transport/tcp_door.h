// Where drivers knock: one listening TCP port, and the lines that it gives them to. It reads and writes
// nothing.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "emulator/clock/asio.h"
#include "emulator/contract/device.h"

namespace echoloop {

class TcpListener;

/// How a door treats its drivers.
struct Manners {
    int send_buffer = 0;               ///< B that the system takes for one that does not read; 0: megabytes
    bool answers_half_closed = false;  ///< one that will say nothing more still gets an answer
    bool speaks_http = false;          ///< else a web browser is hung up on
    /// s that a driver may say and take nothing before another may have its place; none: for ever.
    std::optional<double> idle{};
};

class TcpDoor {
  public:
    /// Throws StartError if the address cannot be bound.
    TcpDoor(asio::io_context& io, Address bind, Manners manners = {});

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
    const Manners& manners() const { return manners_; }
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
    /// Of the driver that has been idle for the longest time, and for long enough; nullptr: there is none.
    TcpListener* idle_line() const;

    asio::io_context& io_;
    Manners manners_;
    asio::ip::tcp::acceptor acceptor_;
    std::vector<TcpListener*> lines_;
    Address shut_;  ///< where it listened; port 0: it is not shut
    bool begun_ = false;
};

}  // namespace echoloop
