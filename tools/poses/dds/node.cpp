#include "tools/poses/dds/node.h"

#include <array>
#include <cstdlib>
#include <memory>

#include <ros2.h>
#include "emulator/contract/error.h"

namespace echoloop::poses {
namespace {

constexpr std::int32_t history = 100;  ///< samples of a topic that wait to be taken

using Qos = std::unique_ptr<dds_qos_t, decltype(&dds_delete_qos)>;

/// What the defaults of ROS 2 agree with. Of fixed transforms what was published before is wanted, too.
Qos qos_of(bool reliable, bool durable) {
    Qos qos(dds_create_qos(), dds_delete_qos);
    dds_qset_reliability(qos.get(), reliable ? DDS_RELIABILITY_RELIABLE : DDS_RELIABILITY_BEST_EFFORT,
                         DDS_MSECS(100));
    dds_qset_durability(qos.get(), durable ? DDS_DURABILITY_TRANSIENT_LOCAL : DDS_DURABILITY_VOLATILE);
    dds_qset_history(qos.get(), DDS_HISTORY_KEEP_LAST, history);
    return qos;
}

std::uint32_t domain_of_environment() {
    constexpr unsigned long most = 232;
    const char* text = std::getenv("ROS_DOMAIN_ID");
    if (text == nullptr || *text == '\0') return 0;
    char* end = nullptr;
    const unsigned long domain = std::strtoul(text, &end, 10);
    if (*end != '\0' || *text == '-' || domain > most)
        throw StartError(Exit::usage,
                         "ROS_DOMAIN_ID is no number from 0 to 232; set it to that of the others");
    return static_cast<std::uint32_t>(domain);
}

dds_entity_t good(dds_entity_t entity, const char* what) {
    if (entity < 0)
        throw StartError(Exit::unavailable, std::string("DDS: ") + what + ": " + dds_strretcode(-entity) +
                                                "; CYCLONEDDS_URI says which network interface it uses");
    return entity;
}

}  // namespace

DdsNode::DdsNode(Heard heard, Refused refused)
    : heard_(std::move(heard)), refused_(std::move(refused)), domain_(domain_of_environment()) {
    participant_ = good(dds_create_participant(domain_, nullptr, nullptr), "no domain can be joined");
    waits_ = good(dds_create_waitset(participant_), "no waiting");
    publications_ = good(dds_create_reader(participant_, DDS_BUILTIN_TOPIC_DCPSPUBLICATION, nullptr, nullptr),
                         "no list of publishers");
}

DdsNode::~DdsNode() { dds_delete(participant_); }

void DdsNode::subscribe(const std::string& topic, const std::string& type) {
    if (type.empty()) {
        unknown_[dds_topic(topic)] = topic;
        return;
    }
    const DdsType* known = find_dds_type(type);
    if (known == nullptr)
        throw StartError(Exit::usage,
                         "'" + type +
                             "' is no type that tells poses; known are Odometry, Pose, "
                             "PoseStamped, PoseWithCovarianceStamped, TransformStamped, TFMessage, "
                             "Clock, as in nav_msgs/msg/Odometry");
    read_with(topic, *known);
}

void DdsNode::read_with(const std::string& topic, const DdsType& type) {
    const bool fixed = topic.ends_with("_static");
    const Qos qos = qos_of(fixed, fixed);
    const dds_entity_t entity =
        good(dds_create_topic(participant_, type.descriptor, dds_topic(topic).c_str(), nullptr, nullptr),
             "no topic");
    const dds_entity_t reader =
        good(dds_create_reader(participant_, entity, qos.get(), nullptr), "no reader");
    dds_set_status_mask(reader, DDS_DATA_AVAILABLE_STATUS);
    good(dds_waitset_attach(waits_, reader, 0), "no waiting");
    readers_.push_back({topic, &type, reader});
}

void DdsNode::look_for_types() {
    constexpr std::size_t most = 64;
    std::array<void*, most> samples{};
    std::array<dds_sample_info_t, most> infos{};
    const int count = dds_take(publications_, samples.data(), infos.data(), most, most);
    for (int i = 0; i < count; ++i) {
        const auto& publisher =
            *static_cast<const dds_builtintopic_endpoint_t*>(samples[static_cast<std::size_t>(i)]);
        if (!infos[static_cast<std::size_t>(i)].valid_data) continue;
        const auto wanted = unknown_.find(publisher.topic_name);
        if (wanted == unknown_.end()) continue;
        const std::string topic = wanted->second;
        if (const DdsType* type = find_dds_type(publisher.type_name)) {
            unknown_.erase(wanted);
            read_with(topic, *type);
        } else if (unfit_.insert_or_assign(topic, publisher.type_name).second) {
            refused_(topic,
                     std::string("its type ") + publisher.type_name + " tells no pose that is known here");
        }
    }
    if (count > 0) dds_return_loan(publications_, samples.data(), count);
}

bool DdsNode::take_from(const Reader& reader) {
    constexpr std::size_t most = 16;
    std::array<void*, most> samples{};
    std::array<dds_sample_info_t, most> infos{};
    const int count = dds_take(reader.entity, samples.data(), infos.data(), most, most);
    for (int i = 0; i < count; ++i) {
        if (!infos[static_cast<std::size_t>(i)].valid_data) continue;
        const DdsHeard said = reader.type->read(samples[static_cast<std::size_t>(i)]);
        if (said.reason.empty())
            heard_(reader.topic, said);
        else
            refused_(reader.topic, said.reason);
    }
    if (count > 0) dds_return_loan(reader.entity, samples.data(), count);
    return count > 0;
}

bool DdsNode::take(int milliseconds) {
    if (!unknown_.empty()) look_for_types();
    dds_waitset_wait(waits_, nullptr, 0, DDS_MSECS(milliseconds));
    bool any = false;
    for (std::size_t i = 0; i < readers_.size(); ++i) any = take_from(readers_[i]) || any;
    return any;
}

void DdsNode::tell(const std::string& topic, Nanoseconds time) {
    constexpr Nanoseconds second = 1'000'000'000;
    auto writer = writers_.find(topic);
    if (writer == writers_.end()) {
        const Qos qos = qos_of(true, false);
        const dds_entity_t entity = good(dds_create_topic(participant_, &rosgraph_msgs_msg_dds__Clock__desc,
                                                          dds_topic(topic).c_str(), nullptr, nullptr),
                                         "no topic");
        writer = writers_
                     .emplace(topic,
                              good(dds_create_writer(participant_, entity, qos.get(), nullptr), "no writer"))
                     .first;
    }
    rosgraph_msgs_msg_dds__Clock_ clock{
        {static_cast<std::int32_t>(time / second), static_cast<std::uint32_t>(time % second)}};
    dds_write(writer->second, &clock);
}

}  // namespace echoloop::poses
