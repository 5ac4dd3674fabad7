// Publishes poses through Debian's ignition-transport, under a type's name of either generation:
//     gz_publisher TOPIC TYPE [NAME...]
// TYPE is gz.msgs.Pose, ignition.msgs.Pose_V, ... Waits for a subscriber and says "connected"; then one
// message for each line of standard input: nanoseconds x y z qw qx qy qz. A Pose_V holds one pose for each
// NAME, of which the last is the one of the line, the others are a hundred metres up. Says "answer
// NANOSECONDS" for each Clock on the topic /answers.
#include <ignition/msgs/clock.pb.h>
#include <ignition/msgs/navsat.pb.h>
#include <ignition/msgs/odometry.pb.h>
#include <ignition/msgs/pose.pb.h>
#include <ignition/msgs/pose_v.pb.h>

#include <chrono>
#include <cstdint>
#include <functional>
#include <ignition/transport/Node.hh>
#include <iostream>
#include <string>
#include <thread>
#include <vector>

namespace {

namespace msgs = ignition::msgs;

struct Line {
    std::int64_t stamp;
    double x, y, z, qw, qx, qy, qz;
};

bool read(Line& line) {
    return static_cast<bool>(std::cin >> line.stamp >> line.x >> line.y >> line.z >> line.qw >> line.qx >>
                             line.qy >> line.qz);
}

template <class Time>
void set(Time* time, std::int64_t stamp) {
    time->set_sec(stamp / 1'000'000'000);
    time->set_nsec(static_cast<std::int32_t>(stamp % 1'000'000'000));
}

void fill(msgs::Pose* pose, const Line& line) {
    pose->mutable_position()->set_x(line.x);
    pose->mutable_position()->set_y(line.y);
    pose->mutable_position()->set_z(line.z);
    pose->mutable_orientation()->set_w(line.qw);
    pose->mutable_orientation()->set_x(line.qx);
    pose->mutable_orientation()->set_y(line.qy);
    pose->mutable_orientation()->set_z(line.qz);
}

std::string message(const std::string& kind, const Line& line, const std::vector<std::string>& names) {
    if (kind == "Clock") {
        msgs::Clock clock;
        set(clock.mutable_sim(), line.stamp);
        return clock.SerializeAsString();
    }
    if (kind == "Odometry") {
        msgs::Odometry odometry;
        set(odometry.mutable_header()->mutable_stamp(), line.stamp);
        fill(odometry.mutable_pose(), line);
        return odometry.SerializeAsString();
    }
    if (kind == "NavSat") {  // x, y, z are latitude, longitude and altitude
        msgs::NavSat fix;
        set(fix.mutable_header()->mutable_stamp(), line.stamp);
        fix.set_latitude_deg(line.x), fix.set_longitude_deg(line.y), fix.set_altitude(line.z);
        return fix.SerializeAsString();
    }
    if (kind == "Pose_V") {
        msgs::Pose_V poses;
        set(poses.mutable_header()->mutable_stamp(), line.stamp);
        for (const auto& name : names) {
            auto* pose = poses.add_pose();
            pose->set_name(name);
            fill(pose, line);
            if (&name != &names.back()) pose->mutable_position()->set_z(100);
        }
        return poses.SerializeAsString();
    }
    msgs::Pose pose;
    set(pose.mutable_header()->mutable_stamp(), line.stamp);
    fill(&pose, line);
    return pose.SerializeAsString();
}

}  // namespace

int main(int argc, char** argv) {
    if (argc < 3) return 64;
    const std::string type = argv[2];
    const std::string kind = type.substr(type.rfind('.') + 1);
    const std::vector<std::string> names(argv + 3, argv + argc);
    ignition::transport::Node node;
    auto publisher = node.Advertise(argv[1], type);
    std::function<void(const msgs::Clock&)> answered = [](const msgs::Clock& clock) {
        std::cout << "answer " << clock.sim().sec() * 1'000'000'000 + clock.sim().nsec() << std::endl;
    };
    if (!node.Subscribe("/answers", answered)) return 70;
    while (!publisher.HasConnections()) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    std::cout << "connected" << std::endl;
    Line line;
    while (read(line))
        if (!publisher.PublishRaw(message(kind, line, names), type)) return 70;
}
