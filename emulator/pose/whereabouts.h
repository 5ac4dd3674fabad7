// Where a body is by what somebody outside tells of it: positions and attitudes apart, since some messages
// tell one of them only. Reads nothing and knows no clock.
#pragma once

#include <cstdint>
#include <optional>

#include "emulator/pose/message.h"
#include "emulator/pose/track.h"

namespace echoloop {

class Whereabouts {
  public:
    /// `before`: where it is until somebody tells. `stepped`: poses come in step with the run's time, so that
    /// nothing need be guessed beyond the last.
    Whereabouts(const Pose& before, bool stepped);

    void tell(Time time, const PoseMessage& message);
    /// In a stepped run: it counts at the end of the next step; of several the last does.
    void tell_with_next_step(const PoseMessage& message);
    /// A step from `from` to `to` begins. What was told nothing about since `from` has not moved until `to`.
    void step(Time from, Time to);

    struct Answer {
        Pose pose;
        bool stale = false;  ///< the last position is too old to be trusted
    };
    Answer at(Time time) const;
    /// As it is told, for a second after the last word, or else by the change of its pose. A velocity of
    /// exactly 0 tells nothing, since senders that know none fill in zeros; who rests does not change.
    Motion motion(Time time) const;
    /// Nobody has told anything yet.
    bool unknown() const { return positions_.empty() && attitudes_.empty(); }
    std::uint64_t jumps() const { return jumps_; }
    /// How many times somebody did; of a stepped run: for how many steps.
    std::uint64_t told() const { return told_; }

  private:
    Pose before_;
    static void tell_rate(Track& track, Time time, const std::optional<Vec3>& rate);

    Track positions_, attitudes_;
    Track velocities_, turnings_;  ///< as positions, of those that are told
    PoseMessage next_;
    std::uint64_t jumps_ = 0, told_ = 0;
};

}  // namespace echoloop
