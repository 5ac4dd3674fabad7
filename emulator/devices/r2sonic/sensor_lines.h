// What motion sensors, satellite receivers and sound velocity probes say to a SIM, one line at a time. Pure
// functions; the formats are those of R2Sonic's operation manual v6.3, chapters 4.1.4 to 4.1.6.
#pragma once

#include <optional>
#include <string_view>

namespace echoloop::r2sonic_device {

/// Angles as Attitude has them.
struct MotionReading {
    double roll = 0;   ///< rad, positive: starboard down
    double pitch = 0;  ///< rad, positive: bow down
    double heave = 0;  ///< m, up
};

/// TSS1, or iXblue's $PHOCT with roll, pitch and heave that are valid (T). Nothing from any other line.
std::optional<MotionReading> read_motion(std::string_view line);

/// A whole second of UTC, and which pulse of the receiver it belongs to.
struct TimeReading {
    double unix_time = 0;  ///< s
    bool of_the_last_pulse = true;
};

/// $GPZDA, which follows its pulse, or Trimble's UTC, which is there half a second before it.
std::optional<TimeReading> read_time(std::string_view line);

/// m/s, 1250 to 1600: a number alone (Valeport miniSVS, SmartSV), the last of SeaBird's four or five, or
/// SVP-C's VVVVVDDDDDTTTBBCCCC, whose V are decimetres a second.
std::optional<double> read_sound_speed(std::string_view line);

/// A sentence of NMEA 0183 whose checksum, if it has one, fits: the SIM passes over those it has no use for.
bool is_sentence(std::string_view line);

}  // namespace echoloop::r2sonic_device
