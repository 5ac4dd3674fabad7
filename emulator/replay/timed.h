// Plays what the device said at the times of the capture, faster or slower, whatever a driver says. Holds one
// message of the capture.
#pragma once

#include <memory>

#include "emulator/replay/player.h"

namespace echoloop::replay {

class TimedPlayer final : public Player {
  public:
    /// `speed`: seconds of the capture that pass in one second, more than 0. `loop`: begin again at the end.
    TimedPlayer(std::unique_ptr<Source> source, double speed, bool loop);

    void arrived(Time now) override;
    void heard(std::size_t, ByteView, Time) override {}
    void reconnected(std::size_t) override {}
    void stepped(Time) override {}
    std::optional<Time> due() const override;
    Outgoing take() override;
    bool ended() const override { return start_ && !next_; }
    const PlayerCounts& counts() const override { return counts_; }

  private:
    void load();

    std::unique_ptr<Source> source_;
    double speed_;
    bool loop_;
    std::optional<Time> start_;  ///< when the lap at hand began
    std::optional<Said> next_;
    Time last_{}, last_gap_{};  ///< of the capture
    PlayerCounts counts_;
};

}  // namespace echoloop::replay
