// What `echoloop bench` renders: sonars, scenes, and the figures that they are to reach. Renders nothing.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "render/renderer.h"

namespace echoloop::bench {

/// A figure to reach, in ms of wall time per ping.
struct Target {
    double aim = 0;
    double least = 0;       ///< the slowest that will do
    std::string reference;  ///< what the figures come from
};

/// One sonar over one scene.
struct Case {
    std::string sonar, scene;
    Shot shot;
    double turn = 0;  ///< rad that the head turns from ping to ping
    std::optional<Target> target{};
    /// Sound speeds over the depth of the scene's water, which bend rays; empty: the same everywhere.
    std::vector<SoundSpeedPoint> profile{};

    std::string name() const { return sonar + "-" + scene + (profile.empty() ? "" : "-thermocline"); }
};

/// The fixed cases; with `scene` every sonar once, over the scene of that name.
std::vector<Case> all_cases();
std::vector<Case> cases_of_scene(const std::string& scene);

/// m, of the sonar below the surface where there is a profile.
inline constexpr double depth_of_profiles = 8;

/// Cases whose name, sonar or scene is one of the comma-separated `words`. Throws StartError (usage) with
/// what is known for a word that fits none.
std::vector<Case> chosen(const std::vector<Case>& cases, const std::string& words);

/// Groups of places in `cases`, in their order: cases by which growth with the triangles is told, of one
/// sonar, are one group, all others one each.
std::vector<std::vector<std::size_t>> groups_of(std::span<const Case> cases);

/// Ping `number` of a case: a head that turns has turned on.
Shot shot_of(const Case& the_case, std::uint64_t number);
/// Where the sonar is then: a vehicle that hovers and never stands still, so that nothing of a ping before
/// can serve.
Pose pose_of(std::uint64_t number);

}  // namespace echoloop::bench
