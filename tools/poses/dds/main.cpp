// echoloop-pose-dds: poses of a ROS 2 system, through DDS and without ROS, to the emulator.
#include <algorithm>
#include <utility>

#include "tools/poses/common/program.h"
#include "tools/poses/common/say.h"
#include "tools/poses/common/stop.h"
#include "tools/poses/common/transforms.h"
#include "tools/poses/dds/node.h"

namespace echoloop::poses {
namespace {

const Program program{
    "echoloop-pose-dds",
    "Sends poses that topics of ROS 2 tell on DDS to a running echoloop: nav_msgs/Odometry; "
    "geometry_msgs/Pose,\n"
    "PoseStamped, PoseWithCovarianceStamped, TransformStamped; tf. The type of a topic is found out.",
    "  echoloop-pose-dds --topic /odom\n"
    "  ROS_DOMAIN_ID=7 echoloop-pose-dds --topic '/tf#base_link' --world map\n"
    "  echoloop-pose-dds --topic /odom --step --to tcp://127.0.0.1:9500    # clock: {mode: stepped}\n\n"
    "CYCLONEDDS_URI says which network interface is used. tools/poses/README.md tells more.",
    "with --step: topic of simulated time (/clock), which steps in place of the poses",
    true,
    false,
    true};

void listen(const Options& options, Feed& feed) {
    Transforms transforms(options, feed);
    const auto heard = [&](const std::string& topic, const DdsHeard& said) {
        if (said.clock && topic == options.clock) return feed.clock(*said.clock);
        if (said.transforms) return transforms.heard(topic, said.bodies);
        feed.heard(topic, said.bodies);
    };
    DdsNode node(heard, [&](const std::string& topic, const std::string& reason) {
        feed.refused(topic, harmless(reason));
    });
    const auto type_of = [&](const std::string& topic) {
        const auto known =
            std::ranges::find(options.types, topic, &std::pair<std::string, std::string>::first);
        return known == options.types.end() ? "" : known->second;
    };
    for (const std::string& topic : topics_of(options)) {
        node.subscribe(topic, type_of(topic));
        if (topic == "/tf" || topic == "tf" || topic.ends_with("/tf"))
            node.subscribe(topic + "_static", "tf2_msgs/msg/TFMessage");
    }
    if (!options.clock.empty()) node.subscribe(options.clock, "rosgraph_msgs/msg/Clock");
    if (!options.answer.empty()) feed.on_step([&](Nanoseconds time) { node.tell(options.answer, time); });
    say_ready(options, "DDS domain " + std::to_string(node.domain()));
    while (!stopped())
        if (!node.take(100)) feed.idle();
}

}  // namespace
}  // namespace echoloop::poses

int main(int argc, char** argv) {
    return echoloop::poses::run_program(argc, argv, echoloop::poses::program, echoloop::poses::listen);
}
