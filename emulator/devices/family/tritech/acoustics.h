// The sound of a scanning head: the figures of its profile, and the band that a command tunes it to. Data and
// pure functions; knows no bytes.
#pragma once

#include <optional>

#include "emulator/contract/settings_list.h"
#include "protocols/seanet/messages.h"

namespace echoloop::tritech {

/// What differs between the transducers of a head, at their own frequency.
struct Band {
    double frequency = 0;                   ///< Hz
    double source_level = 0;                ///< dB re 1 uPa at 1 m
    double beam_width = 0, fan_height = 0;  ///< rad, -3 dB two-way
    double directivity_index = 0;           ///< dB
    double absorption = 0;                  ///< dB/m one way, that the time-varied gain makes up for
};

/// Transducers that a host tunes with TxN and RxN: one for low frequencies beside the usual one.
struct Tunable {
    Band low;
    double lowest = 0, highest = 0;  ///< Hz, what a command may ask for
    double receiver_band = 0;        ///< Hz, how far TxN and RxN may disagree before nothing is heard
};

/// Figures of the profile, in radians where they are angles.
struct Acoustics {
    Band band;
    std::optional<Tunable> tunable;  ///< nothing: a DST, which ignores TxN, RxN and slope
    double bandwidth = 0;            ///< Hz
    double shortest_pulse = 0;       ///< s
    AxisPattern horizontal, vertical;
    Receiver receiver;
    double reference_level = 0;  ///< dB re 1 uPa after TVG: reads 0 dB at zero gain
    double tvg_spreading = 0;    ///< dB per decade of range; 0 with the effect tvg off
    bool tvg = true;             ///< false: neither term
};

/// One channel of mtHeadCommand.
struct Channel {
    std::uint32_t tx_n = 0, rx_n = 0;
    std::uint16_t slope = 0;
};

/// What a command makes of the transducers.
struct Tuning {
    Band band;          ///< of the transducer, scaled to the frequency
    bool deaf = false;  ///< the receiver listens elsewhere
    double tvg = 1;     ///< factor on the time-varied gain
};

Tuning tune(const Acoustics& acoustics, const Channel& channel);

/// The slope that hosts send at a frequency in Hz, and with which the gain makes up for the whole loss.
double usual_slope(double frequency);
/// Hz of a 32-bit frequency word.
double frequency_of(std::uint32_t word);

/// Time-varied gain in dB at slant range `range` m; none closer than a metre.
double tvg_db(double range, const Acoustics& acoustics, const Tuning& tuning);

/// A shot with everything that follows from the profile and the tuning: `pulse` s as commanded; the window
/// and the direction are left to the caller.
Shot sounding(const Acoustics& acoustics, const Tuning& tuning, double pulse);

void describe(Acoustics& acoustics, FigureList& figures);

}  // namespace echoloop::tritech
