#include "emulator/run/kept_scene.h"

#include "emulator/scenario/scene.h"

namespace echoloop {

std::shared_ptr<const Scene> KeptScene::scene_of(const Scenario& scenario) {
    const bool animated = scenario.animations != Animations::off;
    std::vector<std::string> nodes;
    for (const ScenarioObject& object : scenario.objects) nodes.push_back(object.node);
    if (scene_ != nullptr && file_ == scenario.scene && animated_ == animated && nodes_ == nodes)
        return scene_;
    scene_ = load_scene(scenario);
    file_ = scenario.scene;
    animated_ = animated;
    nodes_ = std::move(nodes);
    return scene_;
}

}  // namespace echoloop
