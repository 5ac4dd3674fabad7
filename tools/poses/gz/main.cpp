// echoloop-pose-gz: poses of a Gazebo simulation, through its transport, to the emulator.
#include <condition_variable>
#include <cstdlib>
#include <deque>
#include <ignition/transport/Node.hh>
#include <mutex>
#include <utility>

#include "emulator/contract/error.h"
#include "tools/poses/common/program.h"
#include "tools/poses/common/say.h"
#include "tools/poses/common/stop.h"
#include "tools/poses/gz/messages.h"

namespace echoloop::poses {
namespace {

const Program program{
    "echoloop-pose-gz",
    "Sends poses that topics of Gazebo (ignition or gz) tell to a running echoloop: Pose, Pose_V, Odometry.",
    "  echoloop-pose-gz --topic /model/rov/odometry\n"
    "  echoloop-pose-gz --topic '/world/sea/dynamic_pose/info#rov' --object "
    "'ball=/world/sea/dynamic_pose/info#ball'\n"
    "  echoloop-pose-gz --topic /model/rov/pose --step --to tcp://127.0.0.1:9500    # clock: {mode: "
    "stepped}\n\n"
    "IGN_PARTITION or GZ_PARTITION says which simulation. tools/poses/README.md tells more.",
    "with --step: topic of simulated time (/clock, /stats), which steps in place of the poses",
    false,
    false};

struct Message {
    std::string topic, type, bytes;
};

/// From the transport's threads to this program's one. The oldest wait longest, and are lost first.
class Queue {
  public:
    void put(Message message) {
        constexpr std::size_t most = 1000;
        const std::lock_guard lock(mutex_);
        if (messages_.size() >= most) {
            messages_.pop_front();
            ++lost_;
        }
        messages_.push_back(std::move(message));
        arrived_.notify_one();
    }

    std::optional<Message> take() {
        std::unique_lock lock(mutex_);
        arrived_.wait_for(lock, std::chrono::milliseconds(100), [this] { return !messages_.empty(); });
        if (messages_.empty()) return {};
        Message message = std::move(messages_.front());
        messages_.pop_front();
        return message;
    }

    std::uint64_t lost() const { return lost_; }

  private:
    std::mutex mutex_;
    std::condition_variable arrived_;
    std::deque<Message> messages_;
    std::uint64_t lost_ = 0;
};

/// Debian's transport knows the older names only.
void take_newer_environment() {
    const std::pair<const char*, const char*> names[] = {
        {"GZ_PARTITION", "IGN_PARTITION"}, {"GZ_IP", "IGN_IP"}, {"GZ_RELAY", "IGN_RELAY"}};
    for (const auto& [newer, older] : names)
        if (const char* value = std::getenv(newer)) ::setenv(older, value, 0);
}

void subscribe(ignition::transport::Node& node, Queue& queue, const std::string& topic) {
    const auto heard = [&queue, topic](const char* bytes, std::size_t size,
                                       const ignition::transport::MessageInfo& info) {
        queue.put({topic, info.Type(), {bytes, size}});
    };
    if (!node.SubscribeRaw(topic, heard))
        throw StartError(Exit::usage,
                         "'" + harmless(topic) + "' is no name of a topic; write it as in /model/rov/pose");
}

void hear(const Options& options, Feed& feed, const Message& message) {
    if (message.topic == options.clock) {
        const auto time = read_gz_clock(message.bytes, message.type);
        return time ? feed.clock(*time)
                    : feed.refused(message.topic, "it is no Clock and no WorldStatistics");
    }
    const auto read = read_gz(message.bytes, message.type);
    read.reason.empty() ? feed.heard(message.topic, read.bodies)
                        : feed.refused(message.topic, harmless(read.reason));
}

void listen(const Options& options, Feed& feed) {
    take_newer_environment();
    Queue queue;  // outlives the node, whose threads fill it
    ignition::transport::Node node;
    for (const auto& topic : topics_of(options)) subscribe(node, queue, topic);
    if (!options.clock.empty()) subscribe(node, queue, options.clock);
    ignition::transport::Node::Publisher answers;
    const std::string clock = "ignition.msgs.Clock";
    if (!options.answer.empty()) {
        answers = node.Advertise(options.answer, clock);
        if (!answers)
            throw StartError(Exit::usage, "'" + harmless(options.answer) + "' is no name of a topic");
        feed.on_step([&answers, &clock, first = true](Nanoseconds time) mutable {
            if (std::exchange(first, false)) wait_a_while([&answers] { return answers.HasConnections(); });
            answers.PublishRaw(gz_clock(time), clock);
        });
    }
    say_ready(options, "Gazebo's partition " + node.Options().Partition());
    while (!stopped()) {
        if (const auto message = queue.take())
            hear(options, feed, *message);
        else
            feed.idle();
    }
    if (queue.lost() > 0)
        say(std::to_string(queue.lost()) + " messages were lost: they came faster than they were sent on");
}

}  // namespace
}  // namespace echoloop::poses

int main(int argc, char** argv) {
    return echoloop::poses::run_program(argc, argv, echoloop::poses::program, echoloop::poses::listen);
}
