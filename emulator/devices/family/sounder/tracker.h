// How an altimeter's reading follows the bottom from ping to ping: smoothed, and late after a jump. Knows no
// device.
#pragma once

#include <optional>

namespace echoloop::echosounder {

/// A bottom near the last reading pulls it towards itself, exponentially with the lag. One beyond the gate,
/// or none, leaves it where it is until that has lasted for the patience; then the reading jumps there. The
/// law is our own: only the delay of a real unit is public.
class Tracker {
  public:
    struct Reading {
        double distance = 0;  ///< m
        double trust = 1;     ///< 0 to 1: how well the last ping agrees with it
    };

    /// `lag`: s; 0: every ping speaks for itself.
    explicit Tracker(double lag) : lag_(lag) {}

    /// The reading once a ping at `now` s has found a bottom at `found` m, or none.
    std::optional<Reading> follow(std::optional<double> found, double now);

  private:
    double lag_;
    std::optional<double> reading_;
    double last_ = 0;    ///< s, of the last ping
    double agreed_ = 0;  ///< s, of the last ping whose bottom was within the gate
};

}  // namespace echoloop::echosounder
