// The tree of frames that tf tells, as tf2 keeps it, and the poses of bodies in it. C++17, as ROS 1 has it.
#pragma once

#include <tf2/buffer_core.h>

#include <map>
#include <string>
#include <vector>

#include "tools/poses/common/body_pose.h"

namespace echoloop::poses {

class Ros1Transforms {
  public:
    explicit Ros1Transforms(std::string world) : world_(std::move(world)) {}

    /// False if tf2 takes one of them for nonsense. `fixed`: they hold for all times.
    bool add(const std::vector<BodyPose>& edges, bool fixed);

    /// The body at the latest time for which the whole chain is known, once for each time. Empty if there is
    /// nothing new; `why` says what is missing.
    std::optional<BodyPose> newest(const Source& source, std::string& why);

  private:
    std::string world_;
    tf2::BufferCore frames_;
    std::map<std::string, std::optional<Nanoseconds>> last_;  ///< by frame
};

}  // namespace echoloop::poses
