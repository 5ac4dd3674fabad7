// Pulses of other sonars that a ping hears: the direct way from head to head, in bands that overlap. Knows no
// session and no message.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <vector>

#include "emulator/contract/transmission.h"
#include "render/effects.h"
#include "render/paths/fan_pattern.h"
#include "render/recently_used.h"
#include "render/water.h"

namespace echoloop {

/// Share of the energy of a pulse in the band of a receiver, 0..1: both bands are taken for boxes.
double band_overlap(const Shot& pulse, const Shot& receiver);

/// Another sonar's pulse as a ping hears it.
struct ForeignPulse {
    double first = 0, last = 0;   ///< bins of the ping's window, and parts of them
    double power = 0;             ///< uPa^2 where it arrives
    std::vector<double> receive;  ///< power 0..1 by which each beam hears it
    std::uint64_t key = 0;        ///< of its fluctuations
};

/// Remembers who transmitted when, and adds to a ping the pulses that arrived during its window.
///
/// A pulse arrives at SL - 20 log R - a R (R at least 1 m, where the source level holds), weighted by the
/// transmitter's one-way pattern towards the receiver, by the receiver's one-way pattern in each beam, and by
/// band_overlap(). Housings radiate beside the aperture: a transmitter is never weaker than side_level below
/// its axis. It lasts as long as the pulse, and what the receiver's filter makes of it fluctuates like
/// speckle, keyed by both pings, beam and bin. What is between two heads does not hide them; echoes of
/// another sonar's pulse are left out, as they are far weaker.
class CrossTalk {
  public:
    static constexpr double side_level = -30;  ///< dB re the axis, own choice

    CrossTalk(Water water, Effects effects) : water_(std::move(water)), effects_(effects) {}

    void transmitted(const Transmission& transmission);

    /// `own`: the transmission that `echogram` belongs to. Call it when the window is over.
    std::vector<ForeignPulse> pulses_in(const Echogram& echogram, const Transmission& own);
    /// Saturation is applied again. On any thread.
    void add(std::span<const ForeignPulse> pulses, Echogram& echogram) const;

  private:
    std::optional<ForeignPulse> pulse_in(const Echogram& echogram, const Transmission& own,
                                         const Transmission& other);
    const FanPattern& pattern_of(const Shot& shot);

    Water water_;
    Effects effects_;
    /// By time, one for each array; shots without their beams between the first and the last.
    std::deque<Transmission> recent_;
    RecentlyUsed<FanPattern> patterns_{64};
};

}  // namespace echoloop
