// The truth as messages of rosbridge (protocol version 2, JSON), in the words of ROS 1 or ROS 2: sensor_msgs
// Image and PointCloud2, geometry_msgs PoseStamped. Opens nothing.
#pragma once

#include <string>

#include "tools/poses/truth/picture.h"
#include "tools/poses/truth/ping.h"

namespace echoloop::poses {

struct TruthWords {
    int ros = 2;                ///< generation, 1 or 2
    std::string world = "map";  ///< frame of points and poses
};

/// The points of a cloud, little endian, 16 bytes each: x y z as float32, the object's number and the beam's
/// as uint16. World coordinates, m; of each beam the first surface on its axis.
std::string truth_points(const TruthPing& ping);

std::string advertise_request(const TruthWords& words, const std::string& topic, const std::string& type);
std::string image_message(const TruthWords& words, const std::string& topic, double unix_time,
                          const std::string& frame, const RgbPicture& picture);
std::string points_message(const TruthWords& words, const std::string& topic, const TruthPing& ping);
std::string pose_message(const TruthWords& words, const std::string& topic, const TruthPing& ping);

std::string base64(std::string_view bytes);

}  // namespace echoloop::poses
