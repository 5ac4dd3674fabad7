#include "emulator/pose/movers.h"

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
        if (!object.trajectory.empty())
            source = read_trajectory(object.trajectory);
        else if (object.pose)
            source = *object.pose;
    }
}

std::vector<Pose> Movers::at(Time time) {
    std::vector<std::optional<Pose>> told;
    told.reserve(sources_.size());
    for (const Source& source : sources_) {
        if (const auto* track = std::get_if<Track>(&source))
            told.push_back(track->at(time)->pose);
        else if (const auto* pose = std::get_if<Pose>(&source))
            told.push_back(*pose);
        else
            told.push_back(std::nullopt);
    }
    return mover_poses(scene_->movers(), to_seconds(time), playback_, told);
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
