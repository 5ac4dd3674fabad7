#include "tools/poses/rosbridge/messages.h"

#include <limits>
#include <nlohmann/json.hpp>

namespace echoloop::poses {
namespace {

using Json = nlohmann::json;

constexpr std::size_t most_transforms = 10'000, longest_name = 256;

/// Thrown inside this file only.
struct Refusal {
    std::string reason;
};

const Json& member(const Json& object, const char* key) {
    if (!object.is_object() || !object.contains(key))
        throw Refusal{std::string("\"") + key + "\" is missing"};
    return object[key];
}

std::string line_of(const Json& json) { return json.dump(-1, ' ', true, Json::error_handler_t::replace); }

/// rosbridge says null for numbers that are none.
double number(const Json& object, const char* key) {
    const Json& value = member(object, key);
    if (!value.is_number()) throw Refusal{std::string("\"") + key + "\" is no number"};
    return value.get<double>();
}

std::string text(const Json& object, const char* key) {
    if (!object.is_object() || !object.contains(key) || !object[key].is_string()) return {};
    const auto& value = object[key].get_ref<const std::string&>();
    if (value.size() > longest_name) throw Refusal{std::string("\"") + key + "\" is longer than 256 bytes"};
    return value;
}

/// {"secs", "nsecs"} of ROS 1, {"sec", "nanosec"} of ROS 2.
std::optional<Nanoseconds> stamp(const Json& time) {
    const auto whole = [&time](const char* key) -> std::optional<std::int64_t> {
        if (!time.is_object() || !time.contains(key) || !time[key].is_number_integer()) return {};
        return time[key].get<std::int64_t>();
    };
    const auto seconds = whole("secs") ? whole("secs") : whole("sec");
    const auto nanoseconds = whole("nsecs") ? whole("nsecs") : whole("nanosec");
    if (!seconds || !nanoseconds) throw Refusal{"its time has no seconds and nanoseconds"};
    return stamp_of(*seconds, *nanoseconds);
}

BodyPose body(const Json& place, const Json& q) {
    return {{},
            {},
            {},
            {number(place, "x"), number(place, "y"), number(place, "z")},
            {number(q, "w"), number(q, "x"), number(q, "y"), number(q, "z")}};
}

/// Of a twist, in the axes of the body; null stands for numbers that are none.
std::optional<std::array<double, 3>> rate(const Json& twist, const char* key) {
    if (!twist.is_object() || !twist.contains(key)) return {};
    const Json& v = twist[key];
    for (const char* axis : {"x", "y", "z"})
        if (!member(v, axis).is_number()) return {};
    return {{number(v, "x"), number(v, "y"), number(v, "z")}};
}

BodyPose of_pose(const Json& pose) { return body(member(pose, "position"), member(pose, "orientation")); }

BodyPose with_header(BodyPose body, const Json& message) {
    const Json& header = member(message, "header");
    body.parent = text(header, "frame_id");
    body.name = text(message, "child_frame_id");
    body.stamp = stamp(member(header, "stamp"));
    return body;
}

BodyPose of_transform(const Json& message) {
    const Json& transform = member(message, "transform");
    return with_header(body(member(transform, "translation"), member(transform, "rotation")), message);
}

/// A sensor_msgs/NavSatFix; null stands for an altitude that is not known.
BodyPose of_fix(const Json& message) {
    if (message.contains("status") && message["status"].is_object() &&
        message["status"].value("status", Json(0)) == Json(-1))
        throw Refusal{"its receiver has no fix"};
    BodyPose out = with_header({}, message);
    const bool has_altitude = !member(message, "altitude").is_null();
    out.fix = {number(message, "latitude"), number(message, "longitude"),
               has_altitude ? number(message, "altitude") : std::numeric_limits<double>::quiet_NaN()};
    return out;
}

std::vector<BodyPose> of_transforms(const Json& list) {
    if (!list.is_array() || list.size() > most_transforms)
        throw Refusal{"\"transforms\" is no list of at most 10000"};
    std::vector<BodyPose> edges;
    edges.reserve(list.size());
    for (const auto& edge : list) edges.push_back(of_transform(edge));
    return edges;
}

/// By its shape: the names of types differ between generations, and need not be known here.
void read_message(const Json& message, RosbridgeHeard& heard) {
    if (!message.is_object()) throw Refusal{"its message is no object"};
    if (message.contains("transforms")) {
        heard.bodies = of_transforms(message["transforms"]);
        heard.transforms = true;
    } else if (message.contains("transform")) {
        heard.bodies = {of_transform(message)};
    } else if (message.contains("pose")) {
        const Json& pose = message["pose"];
        const bool with_covariance = pose.is_object() && pose.contains("pose");
        heard.bodies = {with_header(of_pose(with_covariance ? pose["pose"] : pose), message)};
        if (message.contains("twist") && message["twist"].is_object() && message["twist"].contains("twist")) {
            const Json& twist = message["twist"]["twist"];
            heard.bodies[0].velocity = rate(twist, "linear");
            heard.bodies[0].turning = rate(twist, "angular");
        }
    } else if (message.contains("position")) {
        heard.bodies = {of_pose(message)};
    } else if (message.contains("latitude")) {
        heard.bodies = {of_fix(message)};
    } else if (message.contains("clock")) {
        heard.clock = stamp(message["clock"]).value_or(0);
    } else {
        throw Refusal{
            "its message tells no pose that is known here; known are Odometry, Pose, PoseStamped, "
            "PoseWithCovarianceStamped, TransformStamped, TFMessage, NavSatFix"};
    }
}

}  // namespace

RosbridgeHeard read_rosbridge(std::string_view bytes) {
    const Json said = Json::parse(bytes, nullptr, false);
    RosbridgeHeard heard;
    try {
        if (!said.is_object()) throw Refusal{"it is no JSON object"};
        const auto op = text(said, "op");
        if (op == "status") throw Refusal{"rosbridge says: " + line_of(text(said, "msg"))};
        if (op != "publish") return {};
        heard.topic = text(said, "topic");
        read_message(member(said, "msg"), heard);
    } catch (const Refusal& refusal) {
        heard.reason = refusal.reason;
    }
    return heard;
}

std::string subscribe_request(const std::string& topic, const std::string& type) {
    Json request{{"op", "subscribe"},     {"id", "echoloop:" + topic}, {"topic", topic},
                 {"compression", "none"}, {"throttle_rate", 0},        {"queue_length", 0}};
    if (!type.empty()) request["type"] = type;
    return line_of(request);
}

std::string advertise_request(const std::string& topic) {
    return line_of({{"op", "advertise"}, {"topic", topic}, {"type", "rosgraph_msgs/Clock"}});
}

std::string clock_message(const std::string& topic, Nanoseconds time) {
    constexpr Nanoseconds second = 1'000'000'000;
    const Json clock{{"clock", {{"secs", time / second}, {"nsecs", time % second}}}};
    return line_of({{"op", "publish"}, {"topic", topic}, {"msg", clock}});
}

}  // namespace echoloop::poses
