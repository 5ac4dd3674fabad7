// echoloop-pose-ros1: poses of a ROS 1 system, through roscpp, to the emulator.
#include "tools/poses/common/program.h"
#include "tools/poses/common/say.h"
#include "tools/poses/common/stop.h"
#include "tools/poses/ros1/node.h"

namespace echoloop::poses {
namespace {

const Program program{
    "echoloop-pose-ros1",
    "Sends poses that ROS 1 topics tell to a running echoloop: nav_msgs/Odometry; "
    "geometry_msgs/PoseStamped,\n"
    "PoseWithCovarianceStamped, TransformStamped, Pose; tf. The type of a topic is found out.",
    "  echoloop-pose-ros1 --topic /odom\n"
    "  echoloop-pose-ros1 --topic '/tf#base_link' --world map --object ball=/ball/pose\n"
    "  echoloop-pose-ros1 --topic /odom --step --to tcp://127.0.0.1:9500    # clock: {mode: stepped}\n\n"
    "ROS_MASTER_URI says where the master is. tools/poses/README.md tells more.",
    "with --step: topic of simulated time (/clock), which steps in place of the poses",
    true,
    false};

void listen(const Options& options, Feed& feed) {
    const Ros1Ears ears{
        [&feed](const std::string& topic, const std::vector<BodyPose>& bodies) { feed.heard(topic, bodies); },
        [&feed](const Source& source, const BodyPose& body) { feed.heard(source, body); },
        [&feed](const std::string& topic, const std::string& reason) {
            feed.refused(topic, harmless(reason));
        },
        [&feed](Nanoseconds time) { feed.clock(time); },
        [](const std::string& text) { say(harmless(text)); },
        [&feed] { feed.idle(); }};
    Ros1Node node({options.sources, options.clock, options.world, options.answer}, ears, stopped);
    if (!options.answer.empty()) feed.on_step([&node](Nanoseconds time) { node.answer(time); });
    if (!stopped()) say_ready(options, node.master());
    node.listen();
}

}  // namespace
}  // namespace echoloop::poses

int main(int argc, char** argv) {
    return echoloop::poses::run_program(argc, argv, echoloop::poses::program, echoloop::poses::listen);
}
