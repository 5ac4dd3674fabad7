#include "emulator/pose/input.h"

#include <spdlog/spdlog.h>

#include "emulator/contract/endpoint.h"
#include "emulator/pose/limits.h"
#include "emulator/scenario/problems.h"
#include "emulator/transport/make.h"
#include "emulator/transport/standard_streams.h"
#include "emulator/transport/stepped_port.h"
#include "protocols/mavlink/codec.h"

namespace echoloop {
namespace {

constexpr Time another_clock = std::chrono::seconds(1), least_of = std::chrono::milliseconds(500);

std::unique_ptr<Transport> open(asio::io_context& io, const std::string& endpoint,
                                std::span<const Network> peers) {
    if (endpoint == standard_input) return std::make_unique<StandardStreams>(io);
    return open_endpoint(io, endpoint, Browsers::turned_away, peers);
}

bool has_open_number(const std::string& endpoint) {
    if (endpoint == standard_input) return false;
    const Endpoint parsed = parse_endpoint(endpoint);
    return parsed.listens() && parsed.port == 0;
}

}  // namespace

Time SenderClock::run_time(double sender_seconds, Time arrival) {
    const Time ahead = arrival - from_seconds(sender_seconds);
    const bool other =
        ahead_ && (sender_seconds < last_ || std::chrono::abs(ahead - *ahead_) > another_clock);
    if (other) ahead_.reset(), before_.reset();
    if (ahead_ && arrival - since_ >= least_of) before_ = std::exchange(ahead_, std::nullopt);
    if (!ahead_) since_ = arrival;
    ahead_ = ahead_ ? std::min(*ahead_, ahead) : ahead;
    last_ = sender_seconds;
    return from_seconds(sender_seconds) + std::min(*ahead_, before_.value_or(*ahead_));
}

PoseInput::PoseInput(Clock& clock, const std::string& endpoint, std::span<const Network> peers,
                     Whereabouts* where, StepServer* steps, ObjectWhereabouts objects,
                     std::optional<GeoPlace> origin)
    : clock_(clock),
      transport_(in_step(clock, open(clock.io(), endpoint, peers))),
      place_(transport_->describe()),
      endpoint_(has_open_number(endpoint) ? place_ : endpoint),
      comes_back_(endpoint != standard_input),
      datagrams_(transport_->wire().kind == Wire::Kind::udp),
      where_(where),
      objects_(std::move(objects)),
      steps_(steps),
      origin_(origin),
      mavlink_pose_(origin) {}

void PoseInput::start() {
    transport_->start({.received = [this](ByteView bytes, Address from) { received(bytes, from); },
                       .reconnected = [this] { begin(); },
                       .disconnected =
                           [this](Address) {
                               if (!comes_back_) end();
                           }});
}

/// Who stepped the clock, and nobody else can do so in their place, has ended the run.
void PoseInput::end() {
    constexpr std::uint8_t end = '\n';
    if (begun_ && !speaks_mavlink_) received({&end, 1}, {});  // of the last line
    if (has_stepped_) return steps_->finish();
    spdlog::warn("{}: the input has ended; no more {} will come from it", place_,
                 steps_ == nullptr ? "poses" : "lines");
}

/// Somebody else is at the other end.
void PoseInput::begin() {
    ++connection_;
    lines_.clear();
    begun_ = false;
    framer_.clear();
    mavlink_pose_ = MavlinkPose(origin_);
}

void PoseInput::received(ByteView bytes, Address from) {
    constexpr std::uint8_t version1 = 0xFE, version2 = 0xFD;  // no text begins with these
    if (bytes.empty()) return;
    if (datagrams_ || !begun_) speaks_mavlink_ = bytes[0] == version1 || bytes[0] == version2;
    begun_ = true;
    if (speaks_mavlink_) return mavlink(bytes);
    const auto each = [this, from](std::string_view text) { line(text, from); };
    lines_.feed(bytes, each);
    constexpr std::uint8_t end = '\n';
    if (datagrams_) lines_.feed({&end, 1}, each);
}

void PoseInput::mavlink(ByteView bytes) {
    const auto noise = framer_.skipped_bytes();
    framer_.feed(bytes);
    while (const auto frame = framer_.next()) {
        const auto message = mavlink::parse(*frame);
        if (!message) continue;
        PoseText read = mavlink_pose_.add(*message, frame->system, clock_.now());
        if (read.message) read.message->own_clock = true;
        take(read);
    }
    if (framer_.skipped_bytes() != noise) take({{}, "damaged MAVLink, or bytes that are none", {}});
}

void PoseInput::line(std::string_view text, Address from) {
    PoseText read{{}, "the line is longer than 4096 bytes", {}};
    if (!text.empty()) read = parse_pose_line(text);
    if (read.now && steps_ == nullptr)
        read = {{}, "now: the clock of this run is not stepped; that needs clock: {mode: stepped}", read.now};
    place_in_world(read);
    const std::string object = read.message ? read.message->object : "";
    if (!object.empty() && !objects_.contains(object)) read = {{}, why_unknown(object), {}};
    if (read.message && object.empty() && where_ == nullptr)
        read = {{}, "position: vehicle.trajectory says where the vehicle is", {}};
    if (steps_ == nullptr) return take_unstepped(read, from);
    has_stepped_ = has_stepped_ || read.now;
    steps_->add({std::move(read), this, from, connection_});
}

void PoseInput::place_in_world(PoseText& read) const {
    if (!read.message || !read.message->place) return;
    if (!origin_) {
        read = {{},
                "latitude: nothing says where the world lies on the Earth; add origin: {latitude: ..., "
                "longitude: ...} to the scenario",
                read.now};
        return;
    }
    read.message->position = enu_from_place(*origin_, *read.message->place);
    if (!(norm(*read.message->position) <= farthest))
        read = {{}, "latitude, longitude: more than 1000 km from the world's origin", read.now};
}

/// Who waits for an answer gets one, at most one at a time.
void PoseInput::take_unstepped(const PoseText& read, Address from) {
    take(read);
    if (!read.now || answering_) return;
    answering_ = true;
    asio::co_spawn(
        clock_.io(),
        [this, from]() -> Task<void> {
            co_await answer(R"({"error": "the clock of this run is not stepped"})", from, connection_);
            answering_ = false;
        },
        Serving(place_));
}

void PoseInput::take(const PoseText& read) {
    if (!read.reason.empty()) {
        if (summary_.refused++ == 0)
            spdlog::warn("{}: a {} was refused: {}; further ones are only counted", place_,
                         steps_ == nullptr ? "pose" : "line", read.reason);
        summary_.last_refusal = read.reason;
    }
    if (!read.message) return;
    ++summary_.accepted;
    tell(*read.message);
}

/// In a stepped run nothing may depend on when a message arrives between two steps.
void PoseInput::tell(const PoseMessage& message) {
    Whereabouts* const where = message.object.empty() ? where_ : objects_.at(message.object);
    if (where == nullptr) return;
    const Time now = clock_.now();
    if (steps_ == nullptr)
        where->tell(message.time ? sender_.run_time(*message.time, now) : now, message);
    else if (message.time && !message.own_clock)
        where->tell(from_seconds(*message.time), message);
    else
        where->tell_with_next_step(message);
}

std::string PoseInput::why_unknown(const std::string& object) const {
    if (objects_.empty())
        return "object: nothing in this scene moves by lines; add objects: [{node: ...}] to the scenario";
    std::vector<std::string_view> known;
    for (const auto& [name, where] : objects_) known.push_back(name);
    return "object: the scenario has no " + scenario::in_quotes(object) + scenario::suggestion(object, known);
}

Task<void> PoseInput::answer(std::string text, Address to, std::uint64_t connection) {
    if (connection != connection_) co_return;
    text += '\n';
    co_await transport_->write({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}, to);
}

PoseSummary PoseInput::summary() const {
    PoseSummary summary = summary_;
    summary.place = place_;
    return summary;
}

}  // namespace echoloop
