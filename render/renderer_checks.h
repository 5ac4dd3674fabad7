// What a Renderer refuses.
#pragma once

#include <vector>

#include "render/renderer.h"

namespace echoloop {

/// Throws std::invalid_argument, naming the member and its limits.
void validate(const RendererOptions& options);

/// The same for a situation in a scene, whose movers' poses, those at rest included, it returns.
void check(const Situation& situation, const Scene& scene, std::vector<Pose>& movers);

}  // namespace echoloop
