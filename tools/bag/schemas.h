// The definitions of the messages in a bag, as ROS 2 has them (REP-2014's ros2msg): fields and constants.
#pragma once

#include <string>

namespace echoloop::bag {

/// Of "sensor_msgs/msg/Image", with those of all that it holds. Throws std::out_of_range where there is none.
std::string definition_of(const std::string& type);

}  // namespace echoloop::bag
