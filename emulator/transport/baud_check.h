// Makes garbage of what is said and heard while a driver has set another rate than the device talks at, as
// their UARTs would: a decorator around the line of a serial device. It changes nothing while they agree, or
// while the driver has set no rate.
#pragma once

#include "emulator/clock.h"
#include "emulator/transport/decorator.h"

namespace echoloop {

class BaudCheck final : public Decorator {
  public:
    /// `rate`: bit/s of the device. `device`: its name, for the one line in the log.
    BaudCheck(Clock& clock, std::unique_ptr<Transport> line, double rate, std::string device);

    void start(Events events) override;
    Task<void> write(ByteView bytes, Address to) override;
    void close() override;

  private:
    /// Says so in the log, once for each rate.
    bool disagrees_with(const uart::Receiver& driver);
    Task<void> write_garbage(Bytes garbage, Time begin, Time duration);

    Clock& clock_;
    Alarm alarm_;
    double rate_;
    std::string device_;
    double told_ = 0;  ///< the rate of the driver that the log knows of
    Time free_{};      ///< when the last byte has left the wire
    bool closed_ = false;
};

}  // namespace echoloop
