#include "emulator/pose/whereabouts.h"

#include <limits>

namespace echoloop {
namespace {

constexpr std::size_t poses_kept = 2000, poses_kept_in_step = 100000;

TrackRules rules(bool stepped) {
    if (stepped) return {.extrapolation = 0, .most = poses_kept_in_step, .stretch = MotionStretch::before};
    return {.most = poses_kept};
}

/// No rate is a jump.
TrackRules rules_of_rates(bool stepped) {
    TrackRules rates = rules(stepped);
    rates.extrapolation = 0, rates.fastest = std::numeric_limits<double>::infinity();
    return rates;
}

/// Empty where nothing is told of that time, or no longer.
std::optional<Vec3> told_rate(const Track& track, Time time) {
    if (track.empty() || time < track.first()) return {};
    const auto told = track.at(time);
    return told->stale ? std::nullopt : std::optional(told->pose.position);
}

/// It stands where it was, unless somebody has told.
bool hold(Track& track, Time from, Time to) {
    const bool holds = !track.empty() && track.last() <= from && from < to;
    if (holds) track.add(to, track.at(from)->pose);
    return holds;
}

}  // namespace

Whereabouts::Whereabouts(const Pose& before, bool stepped)
    : before_(before),
      positions_(rules(stepped)),
      attitudes_(rules(stepped)),
      velocities_(rules_of_rates(stepped)),
      turnings_(rules_of_rates(stepped)) {}

void Whereabouts::tell(Time time, const PoseMessage& message) {
    if (message.position || message.attitude) ++told_;
    if (message.position && !positions_.add(time, {*message.position, {}})) ++jumps_;
    if (message.attitude) attitudes_.add(time, {{}, *message.attitude});
    if (message.position) tell_rate(velocities_, time, message.velocity);
    if (message.attitude) tell_rate(turnings_, time, message.turning);
}

void Whereabouts::tell_rate(Track& track, Time time, const std::optional<Vec3>& rate) {
    if (rate && *rate != Vec3{})
        track.add(time, {*rate, {}});
    else
        track.clear();
}

void Whereabouts::tell_with_next_step(const PoseMessage& message) {
    if (message.position) next_.position = message.position, next_.velocity = message.velocity;
    if (message.attitude) next_.attitude = message.attitude, next_.turning = message.turning;
}

void Whereabouts::step(Time from, Time to) {
    tell(to, next_);
    next_ = {};
    if (hold(positions_, from, to)) velocities_.clear();
    if (hold(attitudes_, from, to)) turnings_.clear();
}

Whereabouts::Answer Whereabouts::at(Time time) const {
    Answer answer{before_, false};
    if (const auto attitude = attitudes_.at(time)) answer.pose.orientation = attitude->pose.orientation;
    const auto position = positions_.at(time);
    if (!position) return answer;
    return {{position->pose.position, answer.pose.orientation}, position->stale};
}

Motion Whereabouts::motion(Time time) const {
    const auto velocity = told_rate(velocities_, time), turning = told_rate(turnings_, time);
    return {velocity ? *velocity : positions_.motion(time).velocity,
            turning ? *turning : attitudes_.motion(time).turning};
}

}  // namespace echoloop
