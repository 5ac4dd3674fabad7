#include "tools/poses/common/feed.h"

#include <algorithm>
#include <cinttypes>
#include <cstdio>

#include "emulator/pose/frames.h"
#include "tools/poses/common/line.h"
#include "tools/poses/common/say.h"

namespace echoloop::poses {
namespace {

std::string name_of(const Source& source) { return source.object.empty() ? "vehicle" : source.object; }

std::string names_of(const std::vector<BodyPose>& bodies) {
    constexpr std::size_t most = 8;
    std::string names;
    for (std::size_t i = 0; i < std::min(most, bodies.size()); ++i)
        names += (i > 0 ? ", " : "") + harmless(bodies[i].name);
    return names + (bodies.size() > most ? ", ..." : "");
}

/// The body that a source means; empty with `why` if there is none.
const BodyPose* chosen(const Source& source, const std::vector<BodyPose>& bodies, std::string& why) {
    if (source.entry.empty()) {
        if (bodies.size() == 1) return &bodies.front();
        if (!bodies.empty())
            why = "it holds several poses; name one of them as in " + source.topic +
                  "#NAME: " + names_of(bodies);
        return nullptr;
    }
    const auto found = std::find_if(bodies.begin(), bodies.end(),
                                    [&source](const BodyPose& body) { return body.name == source.entry; });
    if (found != bodies.end()) return &*found;
    why = "nothing in it is called '" + source.entry + "', but: " + names_of(bodies);
    return nullptr;
}

Rates rates_of(const BodyPose& body, Quat world_from_body, bool ned) {
    const auto flu = [ned](const std::array<double, 3>& v) {
        const Vec3 told{v[0], v[1], v[2]};
        return ned ? flu_from_frd(told) : told;
    };
    Rates rates;
    if (body.velocity) rates.velocity = rotate(world_from_body, flu(*body.velocity));
    if (body.turning) rates.turning = flu(*body.turning);
    return rates;
}

void print_count(const std::string& what, std::uint64_t number, const std::string& words) {
    std::printf("%-16s %8" PRIu64 " %s\n", what.c_str(), number, words.c_str());
}

}  // namespace

Feed::Feed(const Options& options, Sender& sender) : options_(options), sender_(sender) {
    for (const auto& topic : topics_of(options)) awaited_.insert(topic);
}

void Feed::heard(const std::string& topic, const std::vector<BodyPose>& bodies) {
    for (const auto& source : options_.sources) {
        if (source.topic != topic) continue;
        std::string why;
        if (const auto* body = chosen(source, bodies, why))
            heard(source, *body);
        else if (!why.empty())
            refused(topic, why);
    }
}

void Feed::heard(const Source& source, const BodyPose& body) {
    const auto& [x, y, z] = body.position;
    const auto& [qw, qx, qy, qz] = body.orientation;
    const Pose told{{x, y, z}, {qw, qx, qy, qz}};
    if (const auto fault = body.fix ? fault_of_fix(*body.fix) : fault_of(told); !fault.empty())
        return refused(source.topic, fault);
    const Pose pose = options_.ned ? enu_from_ned(told) : told;
    const Rates rates = rates_of(body, pose.orientation, options_.ned);
    const bool steps = options_.step && options_.clock.empty() && source.object.empty();
    if (options_.step && !body.stamp)
        return refused(source.topic, "it has no time stamp, and --step needs one");
    awaited_.erase(source.topic);
    ++sent_[name_of(source)];
    const auto time = options_.step ? run_time(*body.stamp) : body.stamp;
    const auto line = [&](const char* key) {
        return body.fix ? fix_line(*body.fix, source.object, key, time)
                        : pose_line(pose, source.object, key, time, rates);
    };
    if (steps && time >= now_.value_or(0)) return step(line("now"), *time);
    late_ += steps;
    if (!sender_.send(line("t"))) ++lost_;
}

void Feed::clock(Nanoseconds time) {
    const auto now = run_time(time);
    if (now > now_.value_or(-1)) step(step_line(now), now);
}

/// The first stamp is second 0, unless the user says another.
Nanoseconds Feed::run_time(Nanoseconds stamp) {
    if (!zero_) zero_ = options_.zero.value_or(stamp);
    return stamp - *zero_;
}

void Feed::step(const std::string& line, Nanoseconds now) {
    now_ = now;
    if (!sender_.step(line, now)) {
        ++lost_;
        return;
    }
    ++steps_;
    if (told_) told_(now + *zero_);
}

void Feed::idle() {
    constexpr auto long_enough = std::chrono::seconds(5);
    if (awaited_.empty() || std::chrono::steady_clock::now() < begun_ + long_enough) return;
    for (const auto& topic : awaited_)
        say("no pose has come from " + topic + " yet: is that its name, and does somebody publish it?");
    awaited_.clear();
}

void Feed::refused(const std::string& topic, const std::string& reason) {
    awaited_.erase(topic);
    last_refusal_ = topic + ": " + reason;
    if (refused_++ == 0) say("a message was refused: " + last_refusal_ + "; further ones are counted only");
}

void Feed::print_summary() const {
    for (const auto& source : options_.sources) {
        const auto found = sent_.find(name_of(source));
        print_count(name_of(source), found == sent_.end() ? 0 : found->second, "poses from " + source.topic);
    }
    if (options_.step) print_count("steps", steps_, "answered by " + sender_.place());
    if (late_ > 0) print_count("late", late_, "poses older than the time that was stepped to already");
    if (lost_ > 0) print_count("lost", lost_, "poses that nobody took at " + sender_.place());
    if (refused_ > 0) print_count("refused", refused_, "messages (the last: " + last_refusal_ + ")");
    std::fflush(stdout);
}

}  // namespace echoloop::poses
