// A participant of DDS that hears topics of ROS 2, whatever type their publishers have. Takes no message
// apart.
#pragma once

#include <dds/dds.h>

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "tools/poses/dds/messages.h"

namespace echoloop::poses {

class DdsNode {
  public:
    using Heard = std::function<void(const std::string& topic, const DdsHeard&)>;
    using Refused = std::function<void(const std::string& topic, const std::string& reason)>;

    /// Throws StartError if there is no domain to join: its number is in ROS_DOMAIN_ID, 0 without it.
    DdsNode(Heard heard, Refused refused);
    ~DdsNode();
    DdsNode(const DdsNode&) = delete;
    DdsNode& operator=(const DdsNode&) = delete;

    /// Hears a topic of ROS 2, as soon as its type is known. `type`: of it, or "" to find it out. Throws
    /// StartError (usage) for a type that tells no pose.
    void subscribe(const std::string& topic, const std::string& type);
    /// Hands on what came within the time; true if anything did.
    bool take(int milliseconds);

    /// Tells a time on a topic, as a rosgraph_msgs/Clock.
    void tell(const std::string& topic, Nanoseconds time);
    std::uint32_t domain() const { return domain_; }

  private:
    struct Reader {
        std::string topic;
        const DdsType* type;
        dds_entity_t entity;
    };

    void read_with(const std::string& topic, const DdsType& type);
    void look_for_types();
    bool take_from(const Reader& reader);

    Heard heard_;
    Refused refused_;
    std::uint32_t domain_ = 0;
    dds_entity_t participant_ = 0, waits_ = 0, publications_ = 0;
    std::vector<Reader> readers_;
    std::map<std::string, std::string> unknown_;  ///< topics of ROS 2 without a type, by their names in DDS
    std::map<std::string, std::string> unfit_;    ///< types of theirs that were refused
    std::map<std::string, dds_entity_t> writers_;
};

}  // namespace echoloop::poses
