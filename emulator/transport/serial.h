// A real serial port, opened and set up through libserialport. Its UART gives the line rate; nothing is paced
// here. An adapter that is pulled out never ends the run: the port is opened again when it is back.
#pragma once

#include "emulator/transport/transport.h"
#include "emulator/transport/tty_arrivals.h"

namespace echoloop {

/// A port that this machine has.
struct SerialPortName {
    std::string path;
    bool permitted = false;  ///< for this user
};
std::vector<SerialPortName> serial_ports();

class SerialPort final : public CountingTransport {
  public:
    /// 8 data bits, no parity, one stop bit, no flow control. Throws StartError if the port is missing, busy
    /// or not permitted, or cannot do the rate.
    SerialPort(asio::io_context& io, const std::string& path, int baud);
    ~SerialPort() override { close(); }

    void start(Events events) override;
    /// While the adapter is away what is written is lost.
    Task<void> write(ByteView bytes, Address to) override;
    /// The port itself changes its rate for these writes; it hears nothing at its own meanwhile.
    void speak_at(double rate) override { asked_ = rate; }
    void cut_off() override;
    bool has_driver() const override { return line_.is_open(); }
    void close() override;
    std::string describe() const override;
    double line_rate() const override { return baud_; }

  private:
    Task<void> keep_open();
    /// Until the port is gone; returns why.
    Task<error_code> read_line();
    /// Until the port is there again, or closed for good.
    Task<void> wait_for_return();
    /// Once all that was written has left.
    Task<void> change_to(double rate);

    asio::posix::stream_descriptor line_;
    TtyArrivals arrivals_;
    asio::steady_timer retry_;
    std::string path_;
    int baud_;
    double asked_ = 0;  ///< bit/s of what is written next; 0: baud_
    bool closed_ = false;
    Events events_;
};

}  // namespace echoloop
