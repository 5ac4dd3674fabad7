// What every Doppler log has: where its beams look, its acoustic figures, the noise of its velocities. Data
// only.
#pragma once

#include <vector>

#include "emulator/contract/settings_list.h"

namespace echoloop::doppler {

/// Figures of the profile, in radians where they are angles.
struct Acoustics {
    double frequency = 0;                              ///< Hz
    double shortest_pulse = 0, longest_pulse = 0;      ///< s
    double source_level = 0;                           ///< dB re 1 uPa at 1 m
    double tilt = 0;                                   ///< of each beam, from straight down
    double beam_width = 0;                             ///< two-way
    double lowest_altitude = 0, highest_altitude = 0;  ///< m
    double fastest = 0;                                ///< m/s
    double detection = 0;                              ///< dB above the noise that an echo must have
    double reference_level = 0;                        ///< dB re 1 uPa, reads 0 dBm
    AxisPattern horizontal, vertical;
    Receiver receiver;
};

/// Noise of a beam's velocity: a + b altitude + k speed.
struct Noise {
    double floor = 5e-4;        ///< m/s
    double by_altitude = 2e-4;  ///< m/s per m
    double by_speed = 5e-3;
    double bias = 5e-4;    ///< m/s, drifts
    double scale = 0.001;  ///< standard deviation among units
    double gyro = 5;       ///< deg/h
};

struct Settings {
    std::vector<double> azimuths;   ///< rad of each beam, clockwise from ahead, in the device's own order
    double altitude_offset = 0;     ///< m that the altitude reads less
    double processing_time = 4e-3;  ///< s, from the last echo to the report
    Noise noise;
    Sensors sensors;
    Acoustics acoustics;
};

/// The rows of Noise, but for its scale; `source` is that of its bias.
void describe(Noise& noise, OptionList& options);
/// What a model's own figures do not cover; `reads` says what the level of reference is for.
void describe(Acoustics& acoustics, FigureList& figures, std::string_view reads);

}  // namespace echoloop::doppler
