#include "tools/echoloop/run_bag.h"

#include <cstdio>

#include "tools/echoloop/common.h"

namespace echoloop::cli {

std::unique_ptr<bag::Bag> bag_from(const Arguments& arguments) {
    return arguments.has("--mcap") ? std::make_unique<bag::Bag>(arguments.text("--mcap")) : nullptr;
}

bag::About about(const Runtime& runtime) {
    bag::About all;
    const auto scene = runtime.scene();
    all.objects.assign(scene->objects().begin(), scene->objects().end());
    for (const SceneMover& mover : scene->movers()) all.movers.push_back(mover.name);
    for (const ScenarioDevice& device : runtime.scenario().devices)
        all.families[device.name] = std::string(device.model->family);
    return all;
}

void begin(bag::Bag& bag, const Runtime& runtime) {
    const Scenario& scenario = runtime.scenario();
    bag::BagStart start{.about = about(runtime),
                        .scene = scenario.scene,
                        .scenario = scenario.file,
                        .notes = {{"version", ECHOLOOP_VERSION},
                                  {"scenario", scenario.file.string()},
                                  {"scene", scenario.scene.string()},
                                  {"seed", std::to_string(scenario.seed)}},
                        .waits = scenario.clock == ClockMode::stepped || scenario.clock == ClockMode::free};
    for (const ScenarioDevice& device : scenario.devices)
        start.notes["device " + device.name] = device.model->title;
    bag.begin(std::move(start));
}

void print_bag(const bag::Bag& bag) {
    const bag::BagSummary s = bag.summary();
    std::printf("%s%s: %s, %s%s\n", padded("bag", 16).c_str(), bag.file().c_str(),
                counted(s.messages, "message").c_str(), counted(s.bytes, "byte").c_str(),
                s.lost == 0 ? "" : ("; there was no time for " + counted(s.lost, "more piece")).c_str());
}

}  // namespace echoloop::cli
