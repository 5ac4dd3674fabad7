// The types of the messages that topics have.
#pragma once

namespace echoloop::bag {

inline constexpr const char* image_type = "sensor_msgs/msg/Image";
inline constexpr const char* points_type = "sensor_msgs/msg/PointCloud2";
inline constexpr const char* projected_type = "marine_acoustic_msgs/msg/ProjectedSonarImage";
inline constexpr const char* raw_type = "marine_acoustic_msgs/msg/RawSonarImage";
inline constexpr const char* log_type = "rcl_interfaces/msg/Log";
inline constexpr const char* ranges_type = "marine_acoustic_msgs/msg/SonarRanges";
inline constexpr const char* detections_type = "marine_acoustic_msgs/msg/SonarDetections";

}  // namespace echoloop::bag
