// What the Sonar 3D-15's IMU feels, and its ImuBatch messages (from release 1.8.0 on). Knows no clock.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "emulator/contract/device.h"
#include "protocols/sonar3d/messages.h"
#include "render/pose.h"

namespace echoloop::sonar_3d_15 {

/// Axes x forward, y to starboard, z down, as those of the images.
struct ImuSample {
    sonar3d::Timestamp time;
    Vec3 specific_force;  ///< m/s^2
    Vec3 rate_of_turn;    ///< rad/s
};

/// ImuBatch as protobuf: 1 batch_sequence_id, 2 samples, 3 timestamp.., 4 specific_force, 5 rate_of_turn.
wire::Bytes imu_batch(std::uint32_t number, const std::vector<ImuSample>& samples);

/// It knows its attitude from the pings: gravity, and how it turned from one to the next.
class Imu {
  public:
    void turned(const Quat& world_from_sonar, Time at);
    ImuSample sample(sonar3d::Timestamp time) const { return {time, force_, rate_}; }

  private:
    std::optional<Quat> attitude_;
    Time at_{};
    Vec3 force_{0, 0, -9.81}, rate_{};  ///< level and at rest
};

}  // namespace echoloop::sonar_3d_15
