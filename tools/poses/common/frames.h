// The tree of frames that transforms tell, where there is no tf2: the last of each, put together. Knows no
// middleware and no clock.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "render/pose.h"
#include "tools/poses/common/body_pose.h"

namespace echoloop::poses {

class Frames {
  public:
    explicit Frames(std::string world) : world_(std::move(world)) {}

    /// `fixed`: they have no time. Frames beyond the ten thousandth are passed over.
    void add(const std::vector<BodyPose>& edges, bool fixed);

    /// The body in the world at the newest stamp among its chain's, once for each such stamp. Empty if there
    /// is nothing new; `why` says what is missing.
    std::optional<BodyPose> newest(const std::string& body, std::string& why);

  private:
    struct Edge {
        std::string parent;
        std::optional<Nanoseconds> stamp;
        Pose parent_from_child;
    };
    std::string world_;
    std::map<std::string, Edge> edges_;                       ///< by child
    std::map<std::string, std::optional<Nanoseconds>> last_;  ///< by body
};

}  // namespace echoloop::poses
