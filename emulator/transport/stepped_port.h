// A port as a stepped clock wants it: what arrives while time moves on waits until it stands still again, and
// time waits for what is being written. It changes no byte. It goes right around the transport.
#pragma once

#include "emulator/stepped_clock.h"
#include "emulator/transport/transport.h"

namespace echoloop {

class SteppedPort final : public Transport {
  public:
    /// `clock` calls it until the end of the run and outlives it.
    SteppedPort(SteppedClock& clock, std::unique_ptr<Transport> line);

    void start(Events events) override;
    Task<void> write(ByteView bytes, Address to) override;
    void hang_up() override { line_->hang_up(); }
    void close() override { line_->close(); }
    std::string describe() const override { return line_->describe(); }
    Wire wire() const override { return line_->wire(); }
    uart::Receiver far_end() const override { return line_->far_end(); }
    std::uint64_t bytes_in() const override { return line_->bytes_in(); }
    std::uint64_t bytes_out() const override { return line_->bytes_out(); }
    std::uint64_t bytes_lost() const override { return line_->bytes_lost(); }

  private:
    void received(ByteView bytes, Address from);
    /// Calls `event` now, or behind the step that is being made.
    void in_turn(std::function<void()> event);

    SteppedClock& clock_;
    std::unique_ptr<Transport> line_;
    Events events_;
    std::size_t waiting_ = 0;  ///< bytes that arrived during the step
};

/// `line` itself unless `clock` is a stepped one.
std::unique_ptr<Transport> in_step(Clock& clock, std::unique_ptr<Transport> line);

}  // namespace echoloop
