// Which chunks of a scene a view can see. Conservative; knows no GL.
#pragma once

#include <cstdint>
#include <vector>

#include "render/fan/view.h"
#include "render/scene/scene.h"

namespace echoloop {

/// Indices of the chunks that reach into the view's pyramid (grown by `margin` on the image plane) and are
/// nearer than `end_range`, nearest first.
std::vector<std::uint32_t> visible_chunks(const Scene& scene, const View& view, const Pose& world_from_fan,
                                          double end_range, double margin);

}  // namespace echoloop
