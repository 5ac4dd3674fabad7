#include "emulator/pose/track.h"

#include <algorithm>
#include <cmath>

#include "emulator/pose/limits.h"

namespace echoloop {
namespace {

double dot(Quat a, Quat b) { return a.w * b.w + a.x * b.x + a.y * b.y + a.z * b.z; }

Quat unit(Quat q) {
    const double length = std::sqrt(dot(q, q));
    return {q.w / length, q.x / length, q.y / length, q.z / length};
}

Quat mix(double a, Quat p, double b, Quat q) {
    return {a * p.w + b * q.w, a * p.x + b * q.x, a * p.y + b * q.y, a * p.z + b * q.z};
}

constexpr double smoothing = 0.1;  ///< s, over which motion is the mean

/// By which rotation vector, in the axes of `a`, one gets from `a` to `b`: rad.
Vec3 turn_between(Quat a, Quat b) {
    Quat q = conjugate(a) * b;
    if (q.w < 0) q = {-q.w, -q.x, -q.y, -q.z};
    const Vec3 axis{q.x, q.y, q.z};
    const double sine = norm(axis);
    return sine > 0 ? 2 * std::atan2(sine, q.w) / sine * axis : Vec3{};
}

/// What is no motion but rounding, or no motion that a body could have, is rest.
Vec3 plausible(Vec3 rate) {
    constexpr double rounding = 1e-7;
    const double size = norm(rate);
    return size > rounding && size < swiftest ? rate : Vec3{};
}

}  // namespace

Motion motion_between(const Pose& a, const Pose& b, double seconds) {
    return {plausible(1 / seconds * (b.position - a.position)),
            plausible(1 / seconds * turn_between(a.orientation, b.orientation))};
}

Quat slerp(Quat a, Quat b, double part) {
    constexpr double nearly_the_same = 1 - 1e-10;
    double cosine = dot(a, b);
    const double sign = cosine < 0 ? -1 : 1;
    cosine *= sign;
    if (cosine > nearly_the_same) return unit(mix(1 - part, a, sign * part, b));
    const double angle = std::acos(cosine);
    return unit(mix(std::sin((1 - part) * angle), a, sign * std::sin(part * angle), b));
}

Pose between(const Pose& a, const Pose& b, double part) {
    return {a.position + part * (b.position - a.position), slerp(a.orientation, b.orientation, part)};
}

bool Track::add(Time time, const Pose& pose) {
    if (!poses_.empty() && time <= poses_.back().time) {
        if (time == poses_.back().time) {
            poses_.back().pose = pose;
            return true;
        }
        poses_.clear();
    }
    bool jumped = false;
    if (!poses_.empty()) {
        const double seconds = to_seconds(time - poses_.back().time);
        jumped = norm(pose.position - poses_.back().pose.position) > rules_.fastest * seconds;
    }
    poses_.push_back({time, pose, jumped});
    if (poses_.size() > rules_.most) poses_.pop_front();
    return !jumped;
}

std::optional<Track::Answer> Track::at(Time time) const {
    if (poses_.empty()) return {};
    const auto next = std::ranges::upper_bound(poses_, time, {}, &Entry::time);
    if (next != poses_.begin() && std::prev(next)->time == time) return Answer{std::prev(next)->pose, false};
    if (next == poses_.begin()) return Answer{next->pose, false};
    if (next == poses_.end()) return after_last(time);
    const Entry& before = *std::prev(next);
    if (next->jumped) return Answer{before.pose, false};
    return Answer{between(before.pose, next->pose,
                          to_seconds(time - before.time) / to_seconds(next->time - before.time)),
                  false};
}

Track::Answer Track::after_last(Time time) const {
    const Entry& last = poses_.back();
    const double age = to_seconds(time - last.time);
    Answer answer{last.pose, age > rules_.stale_after};
    if (poses_.size() < 2 || last.jumped) return answer;
    const Entry& before = poses_[poses_.size() - 2];
    const double step = to_seconds(last.time - before.time);
    // Poses that come seldom do not tell how it moves; after a while without one it is where it was seen
    // last.
    if (step <= rules_.steady && age <= rules_.extrapolation * step)
        answer.pose = between(before.pose, last.pose, 1 + age / step);
    return answer;
}

double Track::interval(Entries::const_iterator pose) const {
    return pose == poses_.begin() || pose->jumped ? 0 : to_seconds(pose->time - std::prev(pose)->time);
}

Motion Track::motion(Time time) const {
    constexpr double least = 1e-3;  // s, a stretch that tells anything
    const auto next = std::ranges::upper_bound(poses_, time, {}, &Entry::time);
    if (next == poses_.begin()) return {};
    auto last = std::prev(next);
    double ahead = 0, length = smoothing;
    if (rules_.stretch == MotionStretch::around) ahead = smoothing / 2;
    if (rules_.stretch == MotionStretch::known) {
        const double step = interval(last);
        if (step == 0 || step > rules_.steady) return {};
        ahead = -step, length = std::max(smoothing, step);
    }
    Time end = time + from_seconds(ahead), begin = end - from_seconds(length);
    for (auto first = last;; --first) {
        if (first->time <= begin) break;
        if (first == poses_.begin() || first->jumped) {
            begin = first->time;
            break;
        }
    }
    while (std::next(last) != poses_.end() && !std::next(last)->jumped && last->time < end) ++last;
    end = std::min(end, last->time);
    const double seconds = to_seconds(end - begin);
    return seconds < least ? Motion{} : motion_between(at(begin)->pose, at(end)->pose, seconds);
}

}  // namespace echoloop
