#include "emulator/pose/input.h"

#include <spdlog/spdlog.h>

#include "emulator/transport/make.h"

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

PoseInput::PoseInput(asio::io_context& io, const Clock& clock, const std::string& endpoint,
                     const Pose& before)
    : clock_(clock),
      transport_(open_endpoint(io, endpoint)),
      datagrams_(transport_->wire().kind == Wire::Kind::udp),
      before_(before),
      track_({.most = poses_kept}) {}

void PoseInput::start() {
    transport_->start({.received = [this](ByteView bytes, Address) { received(bytes); },
                       .reconnected =
                           [this] {
                               waiting_.clear();
                               overlong_ = false;
                           }});
}

void PoseInput::received(ByteView bytes) {
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
    const PoseText read = fits ? parse_pose_line(text) : PoseText{{}, "the line is longer than 4096 bytes"};
    if (!read.message) {
        if (summary_.refused++ == 0)
            spdlog::warn("{}: a pose was refused: {}; further ones are counted only", transport_->describe(),
                         read.reason);
        summary_.last_refusal = read.reason;
        return;
    }
    ++summary_.accepted;
    const Time now = clock_.now();
    if (!track_.add(read.message->time ? sender_.run_time(*read.message->time, now) : now,
                    read.message->pose))
        ++summary_.jumps;
}

Pose PoseInput::at(Time time) {
    const auto answer = track_.at(time);
    if (!answer) return before_;
    if (answer->stale && summary_.stale_pings++ == 0)
        spdlog::warn("{}: no pose for more than a second; the vehicle is taken to stand still",
                     transport_->describe());
    return answer->pose;
}

PoseSummary PoseInput::summary() const {
    PoseSummary summary = summary_;
    summary.place = transport_->describe();
    return summary;
}

}  // namespace echoloop
