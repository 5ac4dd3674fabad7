#include "tools/bag/schemas.h"

#include <map>
#include <vector>

namespace echoloop::bag {
namespace {

struct Definition {
    std::string fields;
    std::vector<std::string> parts{};  ///< all types in it, those within them too
};

/// Those of ROS 2 Humble's common_interfaces, and of marine_acoustic_msgs 2.
const std::map<std::string, Definition>& all() {
    static const std::string header = "std_msgs/Header", time = "builtin_interfaces/Time",
                             ping = "marine_acoustic_msgs/PingInfo", vector = "geometry_msgs/Vector3",
                             image = "marine_acoustic_msgs/SonarImageData",
                             flag = "marine_acoustic_msgs/DetectionFlag",
                             quaternion = "geometry_msgs/Quaternion", point = "geometry_msgs/Point",
                             pose = "geometry_msgs/Pose", twist = "geometry_msgs/Twist",
                             transform = "geometry_msgs/Transform";
    static const std::map<std::string, Definition> definitions{
        {time, {"int32 sec\nuint32 nanosec\n"}},
        {header, {"builtin_interfaces/Time stamp\nstring frame_id\n", {time}}},
        {vector, {"float64 x\nfloat64 y\nfloat64 z\n"}},
        {point, {"float64 x\nfloat64 y\nfloat64 z\n"}},
        {quaternion, {"float64 x\nfloat64 y\nfloat64 z\nfloat64 w\n"}},
        {pose, {"Point position\nQuaternion orientation\n", {point, quaternion}}},
        {twist, {"Vector3 linear\nVector3 angular\n", {vector}}},
        {transform, {"Vector3 translation\nQuaternion rotation\n", {vector, quaternion}}},
        {"geometry_msgs/PoseWithCovariance",
         {"Pose pose\nfloat64[36] covariance\n", {pose, point, quaternion}}},
        {"geometry_msgs/TwistWithCovariance", {"Twist twist\nfloat64[36] covariance\n", {twist, vector}}},
        {"geometry_msgs/TransformStamped",
         {"std_msgs/Header header\nstring child_frame_id\nTransform transform\n",
          {header, time, transform, vector, quaternion}}},
        {"tf2_msgs/TFMessage",
         {"geometry_msgs/TransformStamped[] transforms\n",
          {"geometry_msgs/TransformStamped", header, time, transform, vector, quaternion}}},
        {"nav_msgs/Odometry",
         {"std_msgs/Header header\nstring child_frame_id\ngeometry_msgs/PoseWithCovariance pose\n"
          "geometry_msgs/TwistWithCovariance twist\n",
          {header, time, "geometry_msgs/PoseWithCovariance", pose, point, quaternion,
           "geometry_msgs/TwistWithCovariance", twist, vector}}},
        {"std_msgs/String", {"string data\n"}},
        {"sensor_msgs/Image",
         {"std_msgs/Header header\nuint32 height\nuint32 width\nstring encoding\nuint8 is_bigendian\n"
          "uint32 step\nuint8[] data\n",
          {header, time}}},
        {"sensor_msgs/PointField",
         {"uint8 INT8=1\nuint8 UINT8=2\nuint8 INT16=3\nuint8 UINT16=4\nuint8 INT32=5\nuint8 UINT32=6\n"
          "uint8 FLOAT32=7\nuint8 FLOAT64=8\nstring name\nuint32 offset\nuint8 datatype\nuint32 count\n"}},
        {"sensor_msgs/PointCloud2",
         {"std_msgs/Header header\nuint32 height\nuint32 width\nPointField[] fields\nbool is_bigendian\n"
          "uint32 point_step\nuint32 row_step\nuint8[] data\nbool is_dense\n",
          {header, time, "sensor_msgs/PointField"}}},
        {"diagnostic_msgs/KeyValue", {"string key\nstring value\n"}},
        {"diagnostic_msgs/DiagnosticStatus",
         {"byte OK=0\nbyte WARN=1\nbyte ERROR=2\nbyte STALE=3\nbyte level\nstring name\nstring message\n"
          "string hardware_id\nKeyValue[] values\n",
          {"diagnostic_msgs/KeyValue"}}},
        {"diagnostic_msgs/DiagnosticArray",
         {"std_msgs/Header header\nDiagnosticStatus[] status\n",
          {header, time, "diagnostic_msgs/DiagnosticStatus", "diagnostic_msgs/KeyValue"}}},
        {"rcl_interfaces/Log",
         {"byte DEBUG=10\nbyte INFO=20\nbyte WARN=30\nbyte ERROR=40\nbyte FATAL=50\n"
          "builtin_interfaces/Time stamp\nuint8 level\nstring name\nstring msg\nstring file\nstring "
          "function\n"
          "uint32 line\n",
          {time}}},
        {ping,
         {"float32 frequency\nfloat32 sound_speed\nfloat32[] tx_beamwidths\nfloat32[] rx_beamwidths\n"}},
        {flag,
         {"uint8 DETECT_OK=0\nuint8 DETECT_BAD_SONAR=1\nuint8 DETECT_BAD_FILTER=2\nuint8 DETECT_BAD_USER=4\n"
          "uint8 flag\n"}},
        {image,
         {"bool is_bigendian\nuint32 DTYPE_UINT8=0\nuint32 DTYPE_INT8=1\nuint32 DTYPE_UINT16=2\n"
          "uint32 DTYPE_INT16=3\nuint32 DTYPE_UINT32=4\nuint32 DTYPE_INT32=5\nuint32 DTYPE_UINT64=6\n"
          "uint32 DTYPE_INT64=7\nuint32 DTYPE_FLOAT32=8\nuint32 DTYPE_FLOAT64=9\nuint32 dtype\n"
          "uint32 beam_count\nuint8[] data\n"}},
        {"marine_acoustic_msgs/ProjectedSonarImage",
         {"std_msgs/Header header\nPingInfo ping_info\ngeometry_msgs/Vector3[] beam_directions\n"
          "float32[] ranges\nSonarImageData image\n",
          {header, time, ping, vector, image}}},
        {"marine_acoustic_msgs/RawSonarImage",
         {"std_msgs/Header header\nPingInfo ping_info\nfloat32 sample_rate\nuint32 samples_per_beam\n"
          "uint32 sample0\nfloat32[] tx_delays\nfloat32[] tx_angles\nfloat32[] rx_angles\n"
          "SonarImageData image\n",
          {header, time, ping, image}}},
        {"marine_acoustic_msgs/SonarRanges",
         {"std_msgs/Header header\nPingInfo ping_info\nDetectionFlag[] flags\nfloat32[] transmit_delays\n"
          "float32[] intensities\ngeometry_msgs/Vector3[] beam_unit_vec\nfloat32[] ranges\n",
          {header, time, ping, flag, vector}}},
        {"marine_acoustic_msgs/SonarDetections",
         {"std_msgs/Header header\nPingInfo ping_info\nDetectionFlag[] flags\nfloat32[] "
          "two_way_travel_times\n"
          "float32[] tx_delays\nfloat32[] intensities\nfloat32[] tx_angles\nfloat32[] rx_angles\n",
          {header, time, ping, flag}}},
    };
    return definitions;
}

}  // namespace

std::string definition_of(const std::string& type) {
    const auto slash = type.find("/msg/");
    const Definition& definition = all().at(type.substr(0, slash) + type.substr(slash + 4));
    std::string text = definition.fields;
    for (const std::string& part : definition.parts)
        text += std::string(80, '=') + "\nMSG: " + part + "\n" + all().at(part).fields;
    return text;
}

}  // namespace echoloop::bag
