#include "emulator/pose/whereabouts.h"

namespace echoloop {
namespace {

constexpr std::size_t poses_kept = 2000, poses_kept_in_step = 100000;

TrackRules rules(bool stepped) {
    if (stepped) return {.extrapolation = 0, .most = poses_kept_in_step};
    return {.most = poses_kept};
}

/// It stands where it was.
void hold(Track& track, Time from, Time to) {
    if (!track.empty() && track.last() <= from && from < to) track.add(to, track.at(from)->pose);
}

}  // namespace

Whereabouts::Whereabouts(const Pose& before, bool stepped)
    : before_(before), positions_(rules(stepped)), attitudes_(rules(stepped)) {}

void Whereabouts::tell(Time time, const PoseMessage& message) {
    if (message.position || message.attitude) ++told_;
    if (message.position && !positions_.add(time, {*message.position, {}})) ++jumps_;
    if (message.attitude) attitudes_.add(time, {{}, *message.attitude});
}

void Whereabouts::tell_with_next_step(const PoseMessage& message) {
    if (message.position) next_.position = message.position;
    if (message.attitude) next_.attitude = message.attitude;
}

void Whereabouts::step(Time from, Time to) {
    tell(to, next_);
    next_ = {};
    hold(positions_, from, to);
    hold(attitudes_, from, to);
}

Whereabouts::Answer Whereabouts::at(Time time) const {
    Answer answer{before_, false};
    if (const auto attitude = attitudes_.at(time)) answer.pose.orientation = attitude->pose.orientation;
    const auto position = positions_.at(time);
    if (!position) return answer;
    return {{position->pose.position, answer.pose.orientation}, position->stale};
}

}  // namespace echoloop
