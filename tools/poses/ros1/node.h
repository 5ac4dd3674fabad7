// A node of a ROS 1 system that hears poses, transforms and simulated time. Knows nothing of the emulator.
// C++17: the headers of ROS 1 know no later one, so none of them is seen here.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "tools/poses/common/body_pose.h"

namespace echoloop::poses {

struct Ros1Wishes {
    std::vector<Source> sources;
    std::string clock;   ///< topic; empty: none
    std::string world;   ///< root frame of transforms
    std::string answer;  ///< topic to publish times on; empty: none
};

/// Who is told.
struct Ros1Ears {
    std::function<void(const std::string& topic, const std::vector<BodyPose>&)> poses;
    std::function<void(const Source&, const BodyPose&)> body;  ///< made of transforms
    std::function<void(const std::string& topic, const std::string& reason)> refused;
    std::function<void(Nanoseconds)> clock;
    std::function<void(const std::string&)> say;  ///< to a person
    std::function<void()> idle;                   ///< nothing came for a moment
};

class Ros1Node {
  public:
    /// Waits for the master, and says once that it does. Throws std::runtime_error if ROS cannot start.
    Ros1Node(Ros1Wishes wishes, Ros1Ears ears, bool (*stopped)());
    ~Ros1Node();
    Ros1Node(const Ros1Node&) = delete;
    Ros1Node& operator=(const Ros1Node&) = delete;

    /// The address of the master.
    std::string master() const;
    /// Publishes the time on the topic of the answers.
    void answer(Nanoseconds time);
    /// Hands on what comes, until it is stopped.
    void listen();

  private:
    class Listener;
    std::unique_ptr<Listener> listener_;  ///< none: stopped before there was a master
    bool (*stopped_)();
};

}  // namespace echoloop::poses
