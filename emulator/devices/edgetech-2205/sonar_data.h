// What both sides heard of a ping as messages of type 80. Pure functions, and the scaling that goes on from
// ping to ping.
#pragma once

#include "emulator/devices/edgetech-2205/settings.h"
#include "emulator/devices/family/survey/motion_unit.h"
#include "protocols/edgetech/messages.h"

namespace echoloop::edgetech_2205 {

/// How many bits the samples of one side are shifted up, so that they fill 16 bits without an overflow. It
/// goes down at once and up only where much room is left, so that it stays the same from ping to ping.
class Weighting {
  public:
    /// N for samples that reach `peak` V.
    int of(double peak);

  private:
    static constexpr int most = 30;
    int bits_ = most;
};

/// The levels of a side, in V: a sample is V x 2^weighting.
edgetech::SonarData sonar_data(const Echogram& echogram, std::size_t side, const Settings& settings,
                               Weighting& weighting);
/// Settings of the ping, but for the samples.
void describe_ping(edgetech::SonarData& data, const Subsystem& subsystem, std::size_t band,
                   const Settings& settings);
/// `time`: s since 1970.
void stamp(edgetech::SonarData& data, double time);
void tell_place(edgetech::SonarData& data, const survey::Reading& reading, double depth, bool has_position);

}  // namespace echoloop::edgetech_2205
