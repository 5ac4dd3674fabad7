// Makes garbage of what is said and heard while a driver has set another rate than the device talks at, as
// their UARTs would: a decorator around the line of a serial device. It changes nothing while they agree, or
// while the driver has set no rate.
#pragma once

#include "emulator/clock.h"
#include "emulator/transport/transport.h"

namespace echoloop {

class BaudCheck final : public Transport {
  public:
    /// `rate`: bit/s of the device. `device`: its name, for the one line in the log.
    BaudCheck(Clock& clock, std::unique_ptr<Transport> line, double rate, std::string device);

    void start(Events events) override;
    Task<void> write(ByteView bytes, Address to) override;
    void hang_up() override { line_->hang_up(); }
    void close() override;
    std::string describe() const override { return line_->describe(); }
    Wire wire() const override { return line_->wire(); }
    uart::Receiver far_end() const override { return line_->far_end(); }
    std::uint64_t bytes_in() const override { return line_->bytes_in(); }
    std::uint64_t bytes_out() const override { return line_->bytes_out(); }
    std::uint64_t bytes_lost() const override { return line_->bytes_lost(); }

  private:
    /// Says so in the log, once for each rate.
    bool disagrees_with(const uart::Receiver& driver);
    Task<void> write_garbage(Bytes garbage, Time begin, Time duration);

    std::unique_ptr<Transport> line_;
    Clock& clock_;
    Alarm alarm_;
    double rate_;
    std::string device_;
    double told_ = 0;  ///< the rate of the driver that the log knows of
    Time free_{};      ///< when the last byte has left the wire
    bool closed_ = false;
};

}  // namespace echoloop
