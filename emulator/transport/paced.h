// Makes a line as slow as its baud rate: a decorator around the transport of a serial device. It changes when
// bytes arrive, never which.
#pragma once

#include "emulator/clock.h"
#include "emulator/transport/transport.h"

namespace echoloop {

class Paced final : public Transport {
  public:
    /// `bits_per_second` of run time on the wire, ten bits a byte (8N1).
    Paced(Clock& clock, std::unique_ptr<Transport> line, double bits_per_second);

    void start(Events events) override { line_->start(std::move(events)); }
    Task<void> write(ByteView bytes, Address to) override;
    void hang_up() override { line_->hang_up(); }
    void close() override;
    std::string describe() const override { return line_->describe(); }
    Wire wire() const override { return line_->wire(); }
    std::uint64_t bytes_in() const override { return line_->bytes_in(); }
    std::uint64_t bytes_out() const override { return line_->bytes_out(); }

  private:
    std::unique_ptr<Transport> line_;
    Clock& clock_;
    Alarm alarm_;
    std::chrono::duration<double> byte_time_;
    Time free_{};  ///< when the last byte handed over has left the wire
    bool closed_ = false;
};

}  // namespace echoloop
