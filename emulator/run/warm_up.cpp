#include "emulator/run/warm_up.h"

#include "emulator/water/second_time_around.h"
#include "render/renderer.h"

namespace echoloop {

void warm_up(Renderer& renderer, const Scenario& scenario, const SharedWater& water) {
    constexpr double everywhere = 1e7;  // m: a scene so large that late echoes matter
    for (const ScenarioDevice& device : scenario.devices) {
        if (device.model->default_shot == nullptr) continue;  // no sonar
        const Shot shot = device.model->default_shot(device.config, 0, 0);
        const Pose pose = scenario.world_from_body * device.body_from_sonar;
        renderer.render(shot, pose);
        const auto late = late_shot(shot, water.water, water.effects, everywhere);
        if (!late) continue;
        Situation coarse = pose;
        coarse.detail = late_detail;
        renderer.render(*late, coarse);
    }
}

}  // namespace echoloop
