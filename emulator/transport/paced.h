// Makes a line as slow as its baud rate: a decorator around the transport of a serial device. It changes when
// bytes arrive, never which.
#pragma once

#include "emulator/transport/transport.h"

namespace echoloop {

class Paced final : public Transport {
  public:
    /// `bits_per_second` on the wire, ten bits a byte (8N1).
    Paced(asio::io_context& io, std::unique_ptr<Transport> line, double bits_per_second);

    void start(Events events) override { line_->start(std::move(events)); }
    Task<void> write(ByteView bytes, Address to) override;
    void hang_up() override { line_->hang_up(); }
    void close() override;
    std::string describe() const override { return line_->describe(); }
    Wire wire() const override { return line_->wire(); }
    std::uint64_t bytes_in() const override { return line_->bytes_in(); }
    std::uint64_t bytes_out() const override { return line_->bytes_out(); }

  private:
    using Steady = std::chrono::steady_clock;

    std::unique_ptr<Transport> line_;
    asio::steady_timer timer_;
    std::chrono::duration<double> byte_time_;
    Steady::time_point free_{};  ///< when the last byte handed over has left the wire
    bool closed_ = false;
};

}  // namespace echoloop
