#include "tools/poses/gz/messages.h"

#include <ignition/msgs/clock.pb.h>
#include <ignition/msgs/navsat.pb.h>
#include <ignition/msgs/odometry.pb.h>
#include <ignition/msgs/pose.pb.h>
#include <ignition/msgs/pose_v.pb.h>
#include <ignition/msgs/world_stats.pb.h>

#include <utility>

namespace echoloop::poses {
namespace {

namespace msgs = ignition::msgs;

constexpr std::size_t largest = 16 << 20;  // bytes; a world of a hundred thousand poses

/// "Pose_V" of "gz.msgs.Pose_V" and of "ignition.msgs.Pose_V".
std::string_view short_name(std::string_view type) {
    for (const std::string_view generation : {"gz.msgs.", "ignition.msgs."})
        if (type.starts_with(generation)) return type.substr(generation.size());
    return {};
}

template <class M>
std::optional<M> parsed(std::string_view bytes) {
    M message;
    if (bytes.size() > largest || !message.ParseFromArray(bytes.data(), static_cast<int>(bytes.size())))
        return {};
    return message;
}

/// A simulation begins at 0, so that 0 is a time, if it is there.
std::optional<Nanoseconds> stamp(const msgs::Header& header) {
    if (!header.has_stamp()) return {};
    const auto& [seconds, nanoseconds] = std::pair(header.stamp().sec(), header.stamp().nsec());
    return seconds == 0 && nanoseconds == 0 ? 0 : stamp_of(seconds, nanoseconds);
}

std::string named(const msgs::Header& header, std::string_view key) {
    for (const auto& entry : header.data())
        if (entry.key() == key && entry.value_size() > 0) return entry.value(0);
    return {};
}

BodyPose body(const msgs::Pose& pose, const msgs::Header& outer) {
    const auto& own = pose.has_header() ? pose.header() : outer;
    const auto& p = pose.position();
    const auto& q = pose.orientation();
    BodyPose made{named(own, "frame_id"), pose.name(), stamp(own), {p.x(), p.y(), p.z()}, {1, 0, 0, 0}};
    if (!made.stamp) made.stamp = stamp(outer);
    if (made.name.empty()) made.name = named(own, "child_frame_id");
    if (pose.has_orientation()) made.orientation = {q.w(), q.x(), q.y(), q.z()};
    return made;
}

std::vector<BodyPose> bodies(const msgs::Pose& m) { return {body(m, m.header())}; }
std::vector<BodyPose> bodies(const msgs::Odometry& m) {
    BodyPose told = body(m.pose(), m.header());
    if (m.has_twist() && m.twist().has_linear() && m.twist().has_angular()) {
        const auto &v = m.twist().linear(), &w = m.twist().angular();
        told.velocity = {v.x(), v.y(), v.z()}, told.turning = {w.x(), w.y(), w.z()};
    }
    return {told};
}
std::vector<BodyPose> bodies(const msgs::NavSat& m) {
    BodyPose told;
    told.stamp = stamp(m.header());
    told.name = m.frame_id();
    told.fix = {m.latitude_deg(), m.longitude_deg(), m.altitude()};
    return {told};
}
std::vector<BodyPose> bodies(const msgs::Pose_V& m) {
    std::vector<BodyPose> all;
    all.reserve(static_cast<std::size_t>(m.pose_size()));
    for (const auto& pose : m.pose()) all.push_back(body(pose, m.header()));
    return all;
}

template <class M>
GzPoses read(std::string_view bytes) {
    const auto message = parsed<M>(bytes);
    return message ? GzPoses{bodies(*message), ""} : GzPoses{{}, "its bytes are not what its type says"};
}

}  // namespace

GzPoses read_gz(std::string_view bytes, std::string_view type) {
    const auto name = short_name(type);
    if (name == "Pose") return read<msgs::Pose>(bytes);
    if (name == "Pose_V") return read<msgs::Pose_V>(bytes);
    if (name == "Odometry") return read<msgs::Odometry>(bytes);
    if (name == "NavSat") return read<msgs::NavSat>(bytes);
    return {{},
            "its type " + std::string(type) +
                " tells no pose that is known here; known are Pose, Pose_V, Odometry and NavSat "
                "of gz.msgs and ignition.msgs"};
}

std::string gz_clock(Nanoseconds time) {
    constexpr Nanoseconds second = 1'000'000'000;
    msgs::Clock clock;
    clock.mutable_sim()->set_sec(time / second);
    clock.mutable_sim()->set_nsec(static_cast<std::int32_t>(time % second));
    return clock.SerializeAsString();
}

std::optional<Nanoseconds> read_gz_clock(std::string_view bytes, std::string_view type) {
    const auto nanoseconds = [](const msgs::Time& time) {
        return stamp_of(time.sec(), time.nsec()).value_or(0);
    };
    const auto name = short_name(type);
    if (name == "Clock")
        if (const auto message = parsed<msgs::Clock>(bytes)) return nanoseconds(message->sim());
    if (name == "WorldStatistics")
        if (const auto message = parsed<msgs::WorldStatistics>(bytes))
            return nanoseconds(message->sim_time());
    return {};
}

}  // namespace echoloop::poses
