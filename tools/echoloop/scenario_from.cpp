// The scenario and the scene that a command line names.
#include "emulator/pose/trajectory_file.h"
#include "emulator/scenario/scene.h"
#include "tools/echoloop/common.h"
#include "tools/echoloop/example_files.h"

namespace echoloop::cli {

namespace {

/// A trajectory on the globe may need the scene's origin, which is read only then.
Track trajectory_of(const Scenario& scenario) {
    try {
        return read_trajectory(scenario.trajectory, scenario.origin);
    } catch (const StartError&) {
        if (scenario.origin) throw;
        const auto origin = scene_of(scenario)->origin();
        if (!origin) throw;
        return read_trajectory(scenario.trajectory, origin);
    }
}

}  // namespace

Scenario scenario_from(const Arguments& arguments) {
    Scenario scenario =
        load_scenario(file_or_example(arguments.text("FILE")), arguments.all("--set"), models());
    if (!scenario.trajectory.empty()) scenario.world_from_body = trajectory_of(scenario).at({})->pose;
    return scenario;
}

std::shared_ptr<const Scene> scene_of(const Scenario& scenario) {
    try {
        return load_scene(scenario);
    } catch (const SceneError& error) {
        throw StartError(Exit::data, error.what());
    }
}

}  // namespace echoloop::cli
