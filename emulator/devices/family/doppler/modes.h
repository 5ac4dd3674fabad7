// The modes of a Doppler log: which depths it looks for the bottom in, and how often. A small state machine;
// knows no message.
#pragma once

#include <optional>
#include <vector>

#include "emulator/contract/device.h"

namespace echoloop::doppler {

/// Altitudes, m, that a mode is for, and its pings a second.
struct Mode {
    double nearest = 0, farthest = 0, rate = 0;
};
using Modes = std::vector<Mode>;  ///< from the lowest altitudes to the highest

/// Of a log whose maker tells none: four, each of which reaches ten times as far as its nearest bottom,
/// between these altitudes, m. As often as its echoes allow.
Modes usual_modes(double lowest, double highest);

/// Chooses the mode of the next ping: it follows the bottom, goes through all modes without one, and looks
/// for a nearer one now and then.
class ModeSearch {
  public:
    /// Places of the first and the last mode that it may choose.
    void restart(std::size_t lowest, std::size_t highest);
    /// Of the ping that goes out now. `cycling`: nearer modes are tried every ten seconds.
    std::size_t next(bool cycling, Time now);
    /// What that ping found.
    void found(std::optional<double> altitude, const Modes& modes, Time now);
    bool locked() const { return locked_; }
    /// Whether the last ping was a try that found nothing: nobody hears of it.
    bool lost() const { return lost_; }

  private:
    std::size_t lowest_ = 0, highest_ = 0;
    std::size_t mode_ = 0, tried_ = 0;
    bool locked_ = false, trying_ = false, lost_ = false;
    int misses_ = 0;
    Time last_try_{};
};

}  // namespace echoloop::doppler
