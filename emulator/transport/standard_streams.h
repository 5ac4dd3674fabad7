// Standard input and output of this program as one wire: whoever has started it is at the other end.
#pragma once

#include <array>

#include "emulator/contract/endpoint.h"
#include "emulator/transport/transport.h"

namespace echoloop {

class StandardStreams final : public CountingTransport {
  public:
    /// Throws StartError if there is no standard input.
    explicit StandardStreams(asio::io_context& io);
    ~StandardStreams() override { close(); }

    /// `disconnected` is called when standard input ends; it never begins again.
    void start(Events events) override;
    /// Waits for who reads standard output, as print does.
    Task<void> write(ByteView bytes, Address to) override;
    void close() override;
    std::string describe() const override { return std::string(standard_input); }

  private:
    Task<void> read();
    /// What there is, at once; 0 at the end.
    Task<std::size_t> some(error_code& ec);

    asio::posix::stream_descriptor input_;
    int file_ = -1;  ///< a plain file, which nobody need wait for; else -1
    std::array<std::uint8_t, 4096> buffer_{};
    Events events_;
};

}  // namespace echoloop
