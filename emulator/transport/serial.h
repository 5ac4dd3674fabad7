// A real serial port, opened and set up through libserialport. Its UART gives the line rate; nothing is paced
// here.
#pragma once

#include "emulator/transport/transport.h"

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
    Task<void> write(ByteView bytes, Address to) override;
    void close() override;
    std::string describe() const override;

  private:
    Task<void> read_line();

    asio::posix::stream_descriptor line_;
    std::string path_;
    int baud_;
    Events events_;
};

}  // namespace echoloop
