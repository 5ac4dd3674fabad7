// The `effects` of a scenario: which physical effects are on, by name.
#pragma once

#include "emulator/scenario/section.h"
#include "render/renderer.h"

namespace echoloop::scenario {

/// Sets the effects and the speckle of `options` from {name: on|off}; `all` counts first, wherever it stands.
void read_effects(const Value* value, RendererOptions& options, Problems& problems);

}  // namespace echoloop::scenario
