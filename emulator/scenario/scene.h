// The scene that a scenario names, with the parts that it lets move. Draws nothing.
#pragma once

#include <memory>

#include "emulator/scenario/scenario.h"
#include "render/scene/scene.h"

namespace echoloop {

/// Throws SceneError for the scene's own faults and ScenarioError for an object that is no node of the scene.
std::shared_ptr<const Scene> load_scene(const Scenario& scenario);
/// Of the world: the scenario's own, or else the scene's.
std::optional<GeoPlace> origin_of(const Scenario& scenario, const Scene& scene);

}  // namespace echoloop
