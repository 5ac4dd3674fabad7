// Answers a driver with what the device answered in the capture: requests are matched by what they ask for,
// never by the clock. What the device says unasked goes on at its own gaps. Holds no message of the capture
// longer than it is due.
#pragma once

#include <map>
#include <memory>
#include <optional>

#include "emulator/replay/exchanges.h"
#include "emulator/replay/message_reader.h"

namespace echoloop::replay {

class AnsweringPlayer final : public Player {
  public:
    /// Reads the source to its end; `speed` as with TimedPlayer.
    AnsweringPlayer(Source& source, const std::vector<DriverPort>& ports, double speed);

    void arrived(Time now) override;
    void heard(std::size_t port, ByteView bytes, Time now) override;
    void reconnected(std::size_t port) override;
    void stepped(Time) override {}
    std::optional<Time> due() const override;
    Outgoing take() override;
    bool ended() const override { return false; }
    const PlayerCounts& counts() const override { return counts_; }
    const Exchanges& exchanges() const { return exchanges_; }

  private:
    void answer(std::size_t port, const WholeMessage& request, Time now);
    void answer_with(const Exchange& exchange, Time now);
    void move_unasked(const Exchange& exchange, Time now);
    void begin_unasked(std::size_t at, Time due);
    std::optional<Time> unasked_due() const;
    Time scaled(Time time) const { return from_seconds(to_seconds(time) / speed_); }

    Exchanges exchanges_;
    double speed_;
    std::vector<MessageReader> readers_;
    std::multimap<Time, std::size_t> waiting_;  ///< when, and number in said()
    std::optional<std::size_t> unasked_;        ///< the next one; empty: they rest
    Time unasked_time_{};                       ///< when it is due
    bool arrived_ = false;
    PlayerCounts counts_;
};

}  // namespace echoloop::replay
