#include "emulator/pose/movers.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>

#include "emulator/pose/trajectory_file.h"

namespace echoloop {

Movers::Movers(const Scenario& scenario, std::shared_ptr<const Scene> scene)
    : scene_(std::move(scene)),
      playback_(scenario.animations == Animations::once ? Playback::once : Playback::loop),
      sources_(scene_->movers().size()) {
    for (const ScenarioObject& object : scenario.objects) {
        const auto mover = std::ranges::find(scene_->movers(), object.node, &SceneMover::name);
        Source& source = sources_[static_cast<std::size_t>(mover - scene_->movers().begin())];
        const bool lines = object.input.empty() && !object.pose;
        if (!object.trajectory.empty())
            source = read_trajectory(object.trajectory, scenario.origin);
        else if (object.pose && object.input.empty())
            source = *object.pose;
        else
            source =
                Told{Whereabouts(object.pose.value_or(mover->rest), scenario.clock == ClockMode::stepped),
                     object.pose.has_value(), lines};
    }
}

void Movers::open_inputs(const Scenario& scenario, Clock& clock, StepServer* steps) {
    for (const ScenarioObject& object : scenario.objects) {
        if (object.input.empty()) continue;
        const auto mover = std::ranges::find(scene_->movers(), object.node, &SceneMover::name);
        auto& told = std::get<Told>(sources_[static_cast<std::size_t>(mover - scene_->movers().begin())]);
        inputs_.push_back(std::make_unique<PoseInput>(clock, object.input, scenario.peers, &told.where, steps,
                                                      ObjectWhereabouts{}, scenario.origin));
        told.input = inputs_.back().get();
    }
}

void Movers::name_places(Scenario& scenario) const {
    auto input = inputs_.begin();
    for (ScenarioObject& object : scenario.objects)
        if (!object.input.empty()) object.input = (*input++)->endpoint();
}

ObjectWhereabouts Movers::by_lines() {
    ObjectWhereabouts out;
    for (std::size_t i = 0; i < sources_.size(); ++i)
        if (auto* told = std::get_if<Told>(&sources_[i]); told != nullptr && told->by_lines)
            out.emplace(scene_->movers()[i].name, &told->where);
    return out;
}

void Movers::start() {
    for (auto& input : inputs_) input->start();
}

void Movers::close() {
    for (auto& input : inputs_) input->close();
}

void Movers::step(Time from, Time to) {
    for (Source& source : sources_)
        if (auto* told = std::get_if<Told>(&source)) told->where.step(from, to);
}

std::vector<Pose> Movers::at(Time time) {
    for (std::size_t i = 0; i < sources_.size(); ++i)
        if (auto* told = std::get_if<Told>(&sources_[i]);
            told != nullptr && told->where.at(time).stale && told->stale_pings++ == 0)
            spdlog::warn("object {}: no pose for more than a second; it is assumed to stand still",
                         scene_->movers()[i].name);
    return poses(time);
}

std::vector<Pose> Movers::poses(Time time) const {
    std::vector<std::optional<Pose>> told;
    told.reserve(sources_.size());
    for (const Source& source : sources_) {
        if (const auto* track = std::get_if<Track>(&source))
            told.push_back(track->at(time)->pose);
        else if (const auto* pose = std::get_if<Pose>(&source))
            told.push_back(*pose);
        else if (const auto* by = std::get_if<Told>(&source);
                 by != nullptr && (by->placed || !by->where.unknown()))
            told.push_back(by->where.at(time).pose);
        else
            told.push_back(std::nullopt);
    }
    return mover_poses(scene_->movers(), to_seconds(time), playback_, told);
}

/// An animation that begins anew, and a thing that is put elsewhere, are faster than anything moves.
std::vector<Motion> Movers::motions(Time time) const {
    constexpr Time shortly = std::chrono::milliseconds(50);
    constexpr double fastest = TrackRules{}.fastest;
    std::vector<Motion> out;
    if (sources_.empty()) return out;
    const Time earlier = std::max(Time{}, time - shortly);
    if (earlier >= time) return out;
    const std::vector<Pose> before = poses(earlier), now = poses(time);
    for (std::size_t i = 0; i < now.size(); ++i) {
        const Motion motion = motion_between(before[i], now[i], to_seconds(time - earlier));
        out.push_back(norm(motion.velocity) > fastest ? Motion{} : motion);
    }
    return out;
}

std::map<std::string, PoseSummary> Movers::summary() const {
    std::map<std::string, PoseSummary> all;
    for (std::size_t i = 0; i < sources_.size(); ++i) {
        const auto* const told = std::get_if<Told>(&sources_[i]);
        if (told == nullptr) continue;
        PoseSummary& one = all[scene_->movers()[i].name];
        if (told->input != nullptr) one = told->input->summary();
        if (told->input == nullptr) one.place = "lines that name it", one.accepted = told->where.told();
        one.jumps = told->where.jumps();
        one.stale_pings = told->stale_pings;
    }
    return all;
}

std::vector<double> Movers::reach() const {
    std::vector<double> out;
    for (const SceneMover& mover : scene_->movers()) {
        double squares = 0;
        for (std::size_t axis = 0; axis < 3 && !is_empty(mover.bounds); ++axis) {
            const double most = std::max(std::abs(mover.bounds.min[axis]), std::abs(mover.bounds.max[axis]));
            squares += most * most;
        }
        out.push_back(std::sqrt(squares));
    }
    return out;
}

}  // namespace echoloop
