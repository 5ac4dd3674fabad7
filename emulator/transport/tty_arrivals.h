// Tells when a terminal has bytes to read. Never asks a terminal that has none: Linux lets who asks wait for
// the worker that carries bytes across (n_tty_poll and n_tty_read flush its work), which on a busy machine
// takes its turn among all programs. Reads nothing itself.
#pragma once

#include "emulator/clock/asio.h"

namespace echoloop {

class TtyArrivals {
  public:
    explicit TtyArrivals(asio::io_context& io) : edges_(io) {}

    /// Throws StartError if the kernel gives no descriptor.
    void watch(int terminal);
    /// Ends a wait with operation_aborted.
    void close();

    /// Until bytes have come, or the terminal has hung up, since the last wait. Then read all of
    /// them: what is left behind is not told again.
    Task<void> wait(error_code& ec);

  private:
    /// An epoll set that has the terminal in it, to be told of changes only: asio's own asks the terminal
    /// again at every wait.
    asio::posix::stream_descriptor edges_;
};

}  // namespace echoloop
