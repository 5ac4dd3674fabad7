// What one device's pings add to the ground truth. Changes no ping.
#pragma once

#include <functional>
#include <string>
#include <utility>

#include "emulator/contract/transmission.h"
#include "emulator/truth/truth.h"
#include "render/situation.h"

namespace echoloop {

class DeviceTruth {
  public:
    /// Where the sonar is on its vehicle.
    using MountedAt = std::function<Pose(Time)>;

    DeviceTruth(TruthFile* file, std::string device, MountedAt body_from_sonar)
        : file_(file), device_(std::move(device)), body_from_sonar_(std::move(body_from_sonar)) {}
    DeviceTruth(TruthFile* file, std::string device, const Pose& body_from_sonar)
        : DeviceTruth(file, std::move(device), [body_from_sonar](Time) { return body_from_sonar; }) {}

    /// What is true of a ping, but for its values and objects. `unix_time`: s since 1970 when the ping began.
    /// `faults`: those that are on.
    PingTruth of(const Transmission& transmission, const Situation& situation, double unix_time, Time due,
                 std::vector<std::string> faults, const Echogram& echogram) const;
    /// Writes such a ping, with these objects.
    void heard(PingTruth truth, std::vector<std::uint16_t> objects);

  private:
    TruthFile* file_;  ///< nullptr: nobody reads it
    std::string device_;
    MountedAt body_from_sonar_;
};

}  // namespace echoloop
