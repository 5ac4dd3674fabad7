#include "emulator/pose/input.h"

#include <spdlog/spdlog.h>

#include "emulator/transport/make.h"
#include "protocols/mavlink/codec.h"

namespace echoloop {
namespace {

constexpr std::size_t longest_line = 4096, poses_kept = 2000;
constexpr Time another_clock = std::chrono::seconds(1);

}  // namespace

Time SenderClock::run_time(double sender_seconds, Time arrival) {
    const Time ahead = arrival - from_seconds(sender_seconds);
    const bool other =
        ahead_ && (sender_seconds < last_ || std::chrono::abs(ahead - *ahead_) > another_clock);
    ahead_ = ahead_ && !other ? std::min(*ahead_, ahead) : ahead;
    last_ = sender_seconds;
    return from_seconds(sender_seconds) + *ahead_;
}

PoseInput::PoseInput(Clock& clock, const std::string& endpoint, const Pose& before)
    : clock_(clock),
      transport_(open_endpoint(clock.io(), endpoint)),
      place_(transport_->describe()),
      datagrams_(transport_->wire().kind == Wire::Kind::udp),
      before_(before),
      positions_({.most = poses_kept}),
      attitudes_({.most = poses_kept}) {}

void PoseInput::start() {
    transport_->start({.received = [this](ByteView bytes, Address) { received(bytes); },
                       .reconnected = [this] { begin(); }});
}

/// Somebody else is at the other end.
void PoseInput::begin() {
    waiting_.clear();
    overlong_ = begun_ = false;
    framer_.clear();
    mavlink_pose_ = {};
}

void PoseInput::received(ByteView bytes) {
    constexpr std::uint8_t version1 = 0xFE, version2 = 0xFD;  // no text begins with these
    if (bytes.empty()) return;
    if (datagrams_ || !begun_) speaks_mavlink_ = bytes[0] == version1 || bytes[0] == version2;
    begun_ = true;
    speaks_mavlink_ ? mavlink(bytes) : text(bytes);
}

void PoseInput::mavlink(ByteView bytes) {
    framer_.feed(bytes);
    while (const auto frame = framer_.next()) {
        const auto message = mavlink::parse(*frame);
        if (!message) continue;
        take(mavlink_pose_.add(*message, frame->system));
    }
}

void PoseInput::text(ByteView bytes) {
    waiting_.append(bytes.begin(), bytes.end());
    if (datagrams_) waiting_ += '\n';
    std::size_t from = 0;
    for (std::size_t end; (end = waiting_.find('\n', from)) != std::string::npos; from = end + 1) {
        const auto text = std::string_view(waiting_).substr(from, end - from);
        if (!overlong_ && text.find_first_not_of(" \t\r") != std::string_view::npos) line(text);
        overlong_ = false;
    }
    waiting_.erase(0, from);
    if (waiting_.size() <= longest_line) return;
    line("");
    waiting_.clear();
    overlong_ = true;
}

void PoseInput::line(std::string_view text) {
    const bool fits = !text.empty() && text.size() <= longest_line;
    take(fits ? parse_pose_line(text) : PoseText{{}, "the line is longer than 4096 bytes"});
}

void PoseInput::take(const PoseText& read) {
    if (!read.reason.empty()) {
        if (summary_.refused++ == 0)
            spdlog::warn("{}: a pose was refused: {}; further ones are counted only", place_, read.reason);
        summary_.last_refusal = read.reason;
    }
    if (!read.message) return;
    ++summary_.accepted;
    const auto& [told, position, attitude] = *read.message;
    const Time now = clock_.now();
    const Time time = told ? sender_.run_time(*told, now) : now;
    if (position && !positions_.add(time, {*position, {}})) ++summary_.jumps;
    if (attitude) attitudes_.add(time, {{}, *attitude});
}

Pose PoseInput::at(Time time) {
    Pose pose = before_;
    if (const auto attitude = attitudes_.at(time)) pose.orientation = attitude->pose.orientation;
    const auto position = positions_.at(time);
    if (!position) return pose;
    if (position->stale && summary_.stale_pings++ == 0)
        spdlog::warn("{}: no pose for more than a second; the vehicle is taken to stand still", place_);
    pose.position = position->pose.position;
    return pose;
}

PoseSummary PoseInput::summary() const {
    PoseSummary summary = summary_;
    summary.place = place_;
    return summary;
}

}  // namespace echoloop
