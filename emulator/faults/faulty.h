// A transport on which things go wrong as faults are asked for: a decorator around the line of one port. It
// costs nothing while none are.
#pragma once

#include "emulator/clock/clock.h"
#include "emulator/faults/pieces.h"
#include "emulator/transport/decorator.h"

namespace echoloop {

class Faulty final : public Decorator {
  public:
    /// `faults` outlives this. `name`: of the port.
    Faulty(Clock& clock, std::unique_ptr<Transport> line, DeviceFaults& faults, const std::string& name,
           const MessageTraits& traits);

    void start(Events events) override;
    /// While faults are on, the bytes wait in a queue of this line's own.
    Task<void> write(ByteView bytes, Address to) override;
    void speak_at(double rate) override { line_rate_ = rate; }
    void hang_up(Address to) override;
    void close() override;

    void unplug() override;
    void forget() override;
    std::uint64_t bytes_lost() const override;

    /// The device's faults are others now.
    void faults_changed();
    const std::string& port() const { return out_.place().port; }

  private:
    Task<void> keep_sending();
    Task<void> send(Piece piece);
    /// Where the next byte stands in the stream that the driver gets.
    std::uint64_t position();
    Task<void> keep_hearing();
    void hear_what_is_due();
    void hear(const Piece& piece);
    void record(const Pieces& pieces, const FaultEvent& event, std::uint64_t base);

    Clock& clock_;
    DeviceFaults& faults_;
    Pieces out_, in_;
    Alarm out_bell_, in_bell_;  ///< ring when something is due
    Events events_;
    double line_rate_ = 0;  ///< bit/s of what is written next; 0: the line's own
    bool sending_ = false;
    bool closed_ = false;
    std::uint64_t heard_ = 0;                     ///< bytes that the device got
    bool several_;                                ///< drivers on the port, this is the line of one
    Address driver_;                              ///< TCP: the last who came
    std::uint64_t seen_out_ = 0, in_flight_ = 0;  ///< bytes that have left the line, and that are still on it
};

}  // namespace echoloop
