#include "emulator/scenario/scene.h"

#include <algorithm>

namespace echoloop {
namespace {

using namespace scenario;

void check_nodes(const Scenario& scenario, const Scene& scene) {
    Problems problems(scenario.file.string(), {});
    const std::vector<std::string_view> known(scene.node_names().begin(), scene.node_names().end());
    for (const ScenarioObject& object : scenario.objects) {
        const auto count = std::ranges::count(known, object.node);
        const Place place{object.line, object.column};
        if (count == 0)
            problems.add(place, "objects: the scene has no node " + in_quotes(object.node) +
                                    suggestion(object.node, known));
        if (count > 1)
            problems.add(place, "objects: the scene has " + std::to_string(count) + " nodes called " +
                                    in_quotes(object.node) + "; give each a name of its own");
    }
    problems.throw_if_any();
}

}  // namespace

std::optional<GeoPlace> origin_of(const Scenario& scenario, const Scene& scene) {
    return scenario.origin ? scenario.origin : scene.origin();
}

std::shared_ptr<const Scene> load_scene(const Scenario& scenario) {
    SceneOptions options{.animations = scenario.animations != Animations::off};
    for (const ScenarioObject& object : scenario.objects) options.movable.push_back(object.node);
    auto scene = Scene::load(scenario.scene, options);
    check_nodes(scenario, *scene);
    return scene;
}

}  // namespace echoloop
