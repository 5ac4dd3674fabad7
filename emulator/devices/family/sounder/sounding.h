// The settings that every echosounder which pings by itself has, from its options and its profile, and the
// ping that follows from them. Data only; knows no device.
#pragma once

#include <string>
#include <vector>

#include "emulator/contract/settings_list.h"
#include "emulator/devices/family/sounder/bottom.h"

namespace echoloop::echosounder {

/// Figures of the profile, in radians where they are angles.
struct Acoustics {
    double frequency = 0;     ///< Hz
    double pulse_length = 0;  ///< s
    double source_level = 0;  ///< dB re 1 uPa at 1 m
    double beam_width = 0;
    AxisPattern horizontal, vertical;
    Receiver receiver;
};

struct Sounding {
    double rate = 1;                ///< pings per second
    double range = 100;             ///< m, by its own sound speed
    double sound_speed = 1500;      ///< m/s, by which it turns times into depths
    double processing_time = 0.02;  ///< s
    double tracking_lag = 0;        ///< s, of tracker.h
    double baud = 4800;             ///< bit/s; 0: not paced
    Acoustics acoustics{};
    BottomRule bottom{};
    Sensors sensors{};

    /// How long it listens after each pulse, in s: out to the end of its range.
    double window() const { return 2 * range / sound_speed; }
    /// s from ping to ping; never shorter than it takes to listen and to think.
    double period() const;
    /// s that `bytes` take on the line; 0 where it is not paced.
    double line_time(std::size_t bytes) const;
};

/// The options `sound_speed` and `processing_time`, and the figures. The other options differ in defaults and
/// sources.
void describe(Sounding& sounding, OptionList& options, FigureList& figures);

Shot shot_from(const Sounding& sounding);
/// Its ping after `step` others, out to `range` m of the true sound speed if that is not 0.
Shot plain_shot(Sounding sounding, double sound_speed, std::size_t step, double range);

}  // namespace echoloop::echosounder
