// The bursts in which a USB serial adapter hands over what its UART hears: when a packet is full, or when its
// latency timer rings. A decorator around a driver's end of a line; it changes when bytes arrive, never
// which.
#pragma once

#include "emulator/clock/clock.h"
#include "emulator/transport/decorator.h"

namespace echoloop {

class UsbAdapter final : public Decorator {
  public:
    /// `latency`: of its timer; 16 ms in FTDI's chips unless their driver sets another.
    UsbAdapter(Clock& clock, std::unique_ptr<Transport> line, Time latency);

    void start(Events events) override;
    /// Returns at once: what does not fill a packet waits for the timer.
    Task<void> write(ByteView bytes, Address to) override;
    void close() override;

  private:
    Task<void> keep_flushing();

    Clock& clock_;
    Alarm alarm_;
    Time latency_;
    Time rings_{};   ///< when the timer rings next
    Bytes waiting_;  ///< less than a packet
    bool closed_ = false;
};

}  // namespace echoloop
