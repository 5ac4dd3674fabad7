// What a renderer makes at the first ping of a kind: plans, shaders and trees.
#pragma once

#include "emulator/run/session.h"
#include "emulator/scenario/scenario.h"
#include "emulator/water/render_threads.h"

namespace echoloop {

/// Makes it before anybody waits for it, for every sonar of the scenario.
void warm_up(Renderer& renderer, const Scenario& scenario, const SharedWater& water);

}  // namespace echoloop
