// echoloop-pose-rosbridge: poses of a ROS 1 or ROS 2 system, through a rosbridge server, to the emulator.
#include <algorithm>
#include <chrono>
#include <set>
#include <thread>
#include <utility>

#include "tools/poses/common/program.h"
#include "tools/poses/common/say.h"
#include "tools/poses/common/stop.h"
#include "tools/poses/common/transforms.h"
#include "tools/poses/rosbridge/connection.h"
#include "tools/poses/rosbridge/messages.h"

namespace echoloop::poses {
namespace {

const Program program{
    "echoloop-pose-rosbridge",
    "Sends poses that topics of ROS 1 or ROS 2 tell through a rosbridge server to a running echoloop:\n"
    "Odometry, Pose, PoseStamped, PoseWithCovarianceStamped, TransformStamped, tf, NavSatFix.",
    "  echoloop-pose-rosbridge --topic /odom\n"
    "  echoloop-pose-rosbridge --server ws://192.168.2.2:9090 --topic '/tf#base_link' --world map\n"
    "  echoloop-pose-rosbridge --topic /odom --step --to tcp://127.0.0.1:9500    # clock: {mode: stepped}\n\n"
    "The server: ros2 launch rosbridge_server rosbridge_websocket_launch.xml. tools/poses/README.md tells "
    "more.",
    "with --step: topic of simulated time (/clock), which steps in place of the poses",
    true,
    true,
    true};

using Steady = std::chrono::steady_clock;

class Listener {
  public:
    Listener(const Options& options, Feed& feed)
        : options_(options), feed_(feed), transforms_(options, feed), topics_(topics_of(options)) {
        for (const auto& topic : topics_of(options))
            if (topic == "/tf" || topic == "tf" || topic.ends_with("/tf"))
                topics_.push_back(topic + "_static");
        if (!options.clock.empty()) topics_.push_back(options.clock);
    }

    void connected(Connection& connection) {
        silent_ = {topics_.begin(), topics_.end()};
        since_ = {};
        subscribe(connection);
    }

    /// rosbridge says nothing if it cannot tell the type of a topic that has no publisher yet: so ask again.
    void subscribe(Connection& connection) {
        constexpr auto between_requests = std::chrono::seconds(1);
        if (silent_.empty() || Steady::now() < since_ + between_requests) return;
        since_ = Steady::now();
        for (const auto& topic : silent_) connection.write(subscribe_request(topic, type_of(topic)));
    }

    void heard(const std::string& text) {
        const auto said = read_rosbridge(text);
        silent_.erase(said.topic);
        if (!said.reason.empty())
            return feed_.refused(said.topic.empty() ? options_.server : harmless(said.topic),
                                 harmless(said.reason));
        if (said.clock && said.topic == options_.clock) return feed_.clock(*said.clock);
        if (!said.transforms) return feed_.heard(said.topic, said.bodies);
        transforms_.heard(said.topic, said.bodies);
    }

  private:
    std::string type_of(const std::string& topic) const {
        const auto known = std::find_if(options_.types.begin(), options_.types.end(),
                                        [&topic](const auto& type) { return type.first == topic; });
        return known == options_.types.end() ? "" : known->second;
    }

    const Options& options_;
    Feed& feed_;
    Transforms transforms_;
    std::vector<std::string> topics_;
    std::set<std::string> silent_;  ///< topics that nothing has come from since the connection was made
    Steady::time_point since_{};
};

void listen(const Options& options, Feed& feed) {
    Connection connection(options.server);
    Listener listener(options, feed);
    bool said = false;
    if (!options.answer.empty())
        feed.on_step([&](Nanoseconds time) { connection.write(clock_message(options.answer, time)); });
    while (!stopped()) {
        if (!connection.open()) {
            if (!std::exchange(said, true))
                say(options.server + ": " + connection.why() +
                    "; trying until a rosbridge server listens there");
            for (int tenths = 0; tenths < 10 && !stopped(); ++tenths)
                std::this_thread::sleep_for(std::chrono::milliseconds(100));
            continue;
        }
        say_ready(options, options.server);
        if (!options.answer.empty()) connection.write(advertise_request(options.answer));
        listener.connected(connection);
        while (!stopped() && connection.is_open()) {
            if (const auto text = connection.read(100))
                listener.heard(*text);
            else
                feed.idle();
            listener.subscribe(connection);
        }
        if (!stopped()) say(options.server + ": " + connection.why() + "; trying to connect again");
        said = true;
    }
}

}  // namespace
}  // namespace echoloop::poses

int main(int argc, char** argv) {
    return echoloop::poses::run_program(argc, argv, echoloop::poses::program, echoloop::poses::listen);
}
