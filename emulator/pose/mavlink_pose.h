// What MAVLink messages tell of a vehicle's pose, of which some know the position only and some the attitude
// only. Knows no clock and no socket.
#pragma once

#include <optional>

#include "emulator/contract/device.h"
#include "emulator/pose/message.h"
#include "protocols/mavlink/messages.h"
#include "render/geographic.h"

namespace echoloop {

class MavlinkPose {
  public:
    /// `origin`: of the world on the Earth, if that is known.
    explicit MavlinkPose(std::optional<GeoPlace> origin = {}) : origin_(origin) {}

    /// `system`: of the sender, `heard`: when, in run time. The first that tells a pose is the vehicle;
    /// others are refused, until it has told none for 3 s. Of several messages that tell the same thing the
    /// best counts, until it has not come for 3 s: ODOMETRY, SIM_STATE, LOCAL_POSITION_NED,
    /// GLOBAL_POSITION_INT, a SIM_STATE of rounded degrees; ATTITUDE_QUATERNION before ATTITUDE. Places on
    /// the globe become metres east and north of the origin, or without one of the first place (or, if that
    /// was 0, 0, which some say until they know better, of the first one far from there); their z is the
    /// altitude above mean sea level, less the origin's height.
    /// Empty if the message tells nothing better than what came before. `reason` in the answer: another
    /// system, a frame that is none of the world, numbers that are not finite or cannot be.
    PoseText add(const mavlink::Message& message, std::uint8_t system, Time heard);

  private:
    void forget_the_silent(Time now);
    PoseMessage read(const mavlink::Attitude& m);
    PoseMessage read(const mavlink::AttitudeQuaternion& m);
    PoseMessage read(const mavlink::LocalPositionNed& m);
    PoseMessage read(const mavlink::GlobalPositionInt& m);
    PoseMessage read(const mavlink::SimState& m);
    PoseMessage read(const mavlink::Odometry& m);

    Vec3 in_world(const GeoPlace& place);

    std::optional<std::uint8_t> system_;
    std::optional<GeoPlace> origin_, first_;
    int rank_ = 0;                   ///< of the message at hand
    bool place_is_rounded_ = false;  ///< that it tells
    int position_rank_ = 0, attitude_rank_ = 0;
    Time position_heard_{}, attitude_heard_{};  ///< when told last
};

}  // namespace echoloop
