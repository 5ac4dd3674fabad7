// A port as a stepped clock wants it: what arrives while time moves on waits until it stands still again, and
// time waits for what is being written. It changes no byte. It goes right around the transport.
#pragma once

#include "emulator/clock/stepped_clock.h"
#include "emulator/transport/decorator.h"

namespace echoloop {

class SteppedPort final : public Decorator {
  public:
    /// `clock` calls it until the end of the run and outlives it.
    SteppedPort(SteppedClock& clock, std::unique_ptr<Transport> transport);

    void start(Events events) override;
    Task<void> write(ByteView bytes, Address to) override;

  private:
    void received(ByteView bytes, Address from);
    /// Calls `event` now, or behind the step that is being made.
    void in_turn(std::function<void()> event);

    SteppedClock& clock_;
    Events events_;
    std::size_t waiting_ = 0;  ///< bytes that arrived during the step
};

/// `line` itself unless `clock` is a stepped one.
std::unique_ptr<Transport> in_step(Clock& clock, std::unique_ptr<Transport> line);

}  // namespace echoloop
