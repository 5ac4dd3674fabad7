// Makes garbage of what is said and heard while a driver has set another rate than the device talks at, as
// their UARTs would: a decorator around the line of a serial device. It changes nothing while they agree, or
// while the driver has set no rate.
#pragma once

#include <utility>

#include "emulator/clock/clock.h"
#include "emulator/transport/decorator.h"

namespace echoloop {

class BaudCheck final : public Decorator {
  public:
    /// `rate`: bit/s of the device. `device`: its name, for the one line in the log.
    BaudCheck(Clock& clock, std::unique_ptr<Transport> line, double rate, std::string device);

    void start(Events events) override;
    Task<void> write(ByteView bytes, Address to) override;
    void speak_at(double rate) override;
    void cut_off() override;
    void close() override;

  private:
    /// Whether a driver at this rate and the device at that one hear garbage. Says so in the log, once for
    /// each pair.
    bool disagree(double driver, double own);
    /// The rate at which the driver said what is heard now, as far as can be known.
    double rate_of_words();
    Task<void> write_garbage(Bytes garbage, Time begin, Time duration);

    Clock& clock_;
    Alarm alarm_;
    double rate_;
    std::string device_;
    double asked_ = 0;                  ///< at which the device speaks in place of rate_; 0: none
    double seen_ = 0;                   ///< the driver's, when it was looked at last
    bool changes_ = false;              ///< this driver has asked for other rates than the device's
    std::pair<double, double> told_{};  ///< the driver's and the device's that the log knows of
    Time free_{};                       ///< when the last byte has left the wire
    std::uint64_t cuts_ = 0;
    bool closed_ = false;
};

}  // namespace echoloop
