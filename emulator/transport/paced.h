// Makes a line as slow as its baud rate: a decorator around the transport of a serial device. It changes when
// bytes arrive, never which.
#pragma once

#include "emulator/clock/clock.h"
#include "emulator/transport/decorator.h"

namespace echoloop {

class Paced final : public Decorator {
  public:
    /// What another rate than the device's, set by the driver of a pty, does: nothing; set the pace as well
    /// (automatic baud); or leave the pace to the BaudCheck around this one.
    enum class OtherRate { ignored, followed, garbage };

    /// `rate`: bit/s of run time, ten of them a byte (8N1); 0: not paced. A driver's rate that agrees with it
    /// is the pace.
    Paced(Clock& clock, std::unique_ptr<Transport> line, double rate, OtherRate other = OtherRate::ignored);

    void start(Events events) override;
    Task<void> write(ByteView bytes, Address to) override;
    void speak_at(double rate) override;
    void cut_off() override;
    void close() override;
    double line_rate() const override;

  private:
    /// bit/s; 0: not paced.
    double rate_now() const;

    Clock& clock_;
    Alarm alarm_;
    double rate_;
    double asked_ = 0;  ///< in place of rate_; 0: none
    OtherRate other_;
    Time free_{};             ///< when the last byte handed over has left the wire
    std::uint64_t cuts_ = 0;  ///< how often the rest of a message was not to be sent any more
    bool closed_ = false;
};

}  // namespace echoloop
