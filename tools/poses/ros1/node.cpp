#include "tools/poses/ros1/node.h"

#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <rosgraph_msgs/Clock.h>
#include <unistd.h>

#include <algorithm>
#include <set>
#include <utility>

#include "tools/poses/common/stop.h"
#include "tools/poses/ros1/messages.h"
#include "tools/poses/ros1/transforms.h"

namespace echoloop::poses {
namespace {

using Message = topic_tools::ShapeShifter;  // of whatever type the publisher has

/// roscpp does not say that it waits for its master, and does not end while it does.
bool wait_for_master(const Ros1Ears& ears, bool (*stopped)()) {
    bool said = false;
    while (!stopped() && !ros::master::check()) {
        if (!std::exchange(said, true))
            ears.say("no ROS master at " + ros::master::getURI() +
                     "; waiting for one: start roscore or rosmaster, or set ROS_MASTER_URI");
        constexpr unsigned between_tries = 200'000;  // us
        ::usleep(between_tries);
    }
    return !stopped();
}

bool tells_transforms(const std::string& topic) {
    return topic == "tf" || (topic.size() > 2 && topic.compare(topic.size() - 3, 3, "/tf") == 0);
}

rosgraph_msgs::Clock clock_message(Nanoseconds time) {
    rosgraph_msgs::Clock message;
    message.clock.fromNSec(static_cast<std::uint64_t>(std::max<Nanoseconds>(0, time)));
    return message;
}

}  // namespace

class Ros1Node::Listener {
  public:
    Listener(Ros1Wishes wishes, Ros1Ears ears)
        : wishes_(std::move(wishes)), ears_(std::move(ears)), transforms_(wishes_.world) {
        node_.setCallbackQueue(&queue_);
        std::set<std::string> topics;
        for (const auto& source : wishes_.sources) topics.insert(source.topic);
        for (const auto& topic : topics) {
            subscribe(topic, [this, topic](const Message& m) { heard(topic, m); });
            if (tells_transforms(topic))
                subscribe(topic + "_static",
                          [this, topic](const Message& m) { keep(topic, read_ros1(m), true); });
        }
        constexpr std::uint32_t most_waiting_answers = 1000;
        if (!wishes_.answer.empty())
            answers_ = node_.advertise<rosgraph_msgs::Clock>(wishes_.answer, most_waiting_answers);
        if (!wishes_.clock.empty()) subscribe(wishes_.clock, [this](const Message& m) { clock(m); });
    }

    void wait_for_messages() {
        queue_.callAvailable(ros::WallDuration(0.1));
        ears_.idle();
    }

    void answer(Nanoseconds time) {
        if (!std::exchange(answered_, true))
            wait_a_while([this] { return answers_.getNumSubscribers() > 0; });
        answers_.publish(clock_message(time));
    }

  private:
    template <class Function>
    void subscribe(const std::string& topic, Function function) {
        const boost::function<void(const boost::shared_ptr<Message const>&)> call =
            [function](const boost::shared_ptr<Message const>& message) { function(*message); };
        constexpr std::uint32_t most_waiting = 1000;
        subscribers_.push_back(
            node_.subscribe<Message>(topic, most_waiting, call, {}, ros::TransportHints().tcpNoDelay()));
    }

    void heard(const std::string& topic, const Message& message) {
        const auto read = read_ros1(message);
        if (!read.reason.empty()) return ears_.refused(topic, read.reason);
        if (!read.transforms) return ears_.poses(topic, read.bodies);
        keep(topic, read, false);
        for (const auto& source : wishes_.sources)
            if (source.topic == topic) look_up(source);
    }

    void keep(const std::string& topic, const Ros1Poses& read, bool fixed) {
        if (!read.reason.empty()) return ears_.refused(topic, read.reason);
        if (!transforms_.add(read.bodies, fixed))
            ears_.refused(topic, "tf2 does not take one of its transforms");
    }

    void look_up(const Source& source) {
        if (source.entry.empty())
            return ears_.refused(source.topic,
                                 "say which frame is the body, as in " + source.topic + "#base_link");
        std::string why;
        if (const auto body = transforms_.newest(source, why)) return ears_.body(source, *body);
        if (!why.empty() && said_.insert(source.entry).second)
            ears_.say(source.topic + ": " + why + " Waiting for it; --world names the root.");
    }

    void clock(const Message& message) {
        if (const auto time = read_ros1_clock(message)) return ears_.clock(*time);
        ears_.refused(wishes_.clock, "it is no rosgraph_msgs/Clock");
    }

    Ros1Wishes wishes_;
    Ros1Ears ears_;
    ros::NodeHandle node_;
    ros::CallbackQueue queue_;
    std::vector<ros::Subscriber> subscribers_;
    ros::Publisher answers_;
    bool answered_ = false;
    Ros1Transforms transforms_;
    std::set<std::string> said_;
};

Ros1Node::Ros1Node(Ros1Wishes wishes, Ros1Ears ears, bool (*stopped)()) : stopped_(stopped) {
    using namespace ros::init_options;
    ros::M_string no_remappings;
    ros::init(no_remappings, "echoloop_pose", AnonymousName | NoSigintHandler | NoRosout);
    if (wait_for_master(ears, stopped))
        listener_ = std::make_unique<Listener>(std::move(wishes), std::move(ears));
}

Ros1Node::~Ros1Node() {
    listener_.reset();
    ros::shutdown();
}

std::string Ros1Node::master() const { return ros::master::getURI(); }

void Ros1Node::answer(Nanoseconds time) {
    if (listener_) listener_->answer(time);
}

void Ros1Node::listen() {
    while (listener_ && !stopped_() && ros::ok()) listener_->wait_for_messages();
}

}  // namespace echoloop::poses
