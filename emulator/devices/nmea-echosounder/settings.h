// The options and the profile of an NMEA echosounder as typed values, and the ping that follows from them.
// Data only.
#pragma once

#include <string>
#include <vector>

#include "emulator/devices/nmea-echosounder/bottom.h"
#include "emulator/model.h"
#include "protocols/nmea/sentences.h"

namespace echoloop::nmea_echosounder {

/// Figures of the profile, in radians where they are angles.
struct Acoustics {
    double frequency = 0;     ///< Hz
    double pulse_length = 0;  ///< s
    double source_level = 0;  ///< dB re 1 uPa at 1 m
    double beam_width = 0;
    AxisPattern horizontal, vertical;
    Receiver receiver;
};

struct Settings {
    nmea::Style style;
    std::vector<std::string> sentences;  ///< formatters in their order: "DPT", "DBT", "MTW", "DBS", "DBK"
    bool range_in_dpt = true;
    bool silent_without_bottom = false;
    double rate = 1;            ///< pings and groups of sentences per second
    double range = 100;         ///< m, by its own sound speed
    double offset = 0;          ///< m, as DPT has it
    double sound_speed = 1500;  ///< m/s, by which it turns times into depths
    double temperature = 10;    ///< degrees Celsius
    double processing = 0.02;   ///< s
    double baud = 4800;         ///< bit/s; 0: not paced
    Acoustics acoustics;
    BottomRule bottom;

    /// How long it listens after each pulse, in s: out to the end of its range.
    double window() const { return 2 * range / sound_speed; }
    /// s from ping to ping; never shorter than it takes to listen and to think.
    double period() const;
};

/// From complete options and a complete profile; std::invalid_argument if options contradict each other.
Settings read_settings(const DeviceConfig& config);
/// The tables that `echoloop list` shows.
std::vector<Option> option_table();
std::vector<FigureRow> figure_table();

Shot shot_from(const Settings& settings);

}  // namespace echoloop::nmea_echosounder
