// What a renderer makes at the first ping of a kind: plans, shaders and trees.
#pragma once

#include "emulator/water/render_thread.h"
#include "emulator/scenario/scenario.h"
#include "emulator/run/session.h"

namespace echoloop {

/// Makes it before anybody waits for it, for every sonar of the scenario that `lane` serves.
void warm_up(Renderer& renderer, const Scenario& scenario, const SharedWater& water, RenderThread::Lane lane);

}  // namespace echoloop
