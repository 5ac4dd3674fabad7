// Plays what the device said one message at a time: the next one when the driver has asked for something, or
// when a person says so. Knows no times; holds one message of the capture.
#pragma once

#include <memory>

#include "emulator/replay/message_reader.h"
#include "emulator/replay/player.h"

namespace echoloop::replay {

class SteppedPlayer final : public Player {
  public:
    SteppedPlayer(std::unique_ptr<Source> source, const std::vector<DriverPort>& ports, bool loop);

    void arrived(Time) override {}
    void heard(std::size_t port, ByteView bytes, Time now) override;
    void reconnected(std::size_t port) override { readers_[port].clear(); }
    void stepped(Time now) override;
    std::optional<Time> due() const override;
    Outgoing take() override;
    bool ended() const override { return !next_; }
    const PlayerCounts& counts() const override { return counts_; }

  private:
    void load();

    std::unique_ptr<Source> source_;
    std::vector<MessageReader> readers_;
    bool loop_;
    std::optional<Said> next_;
    std::uint64_t steps_ = 0;  ///< asked for and not yet taken
    Time asked_{};
    PlayerCounts counts_;
};

}  // namespace echoloop::replay
