// How much more or less of the sound of bent rays comes back than of straight ones, per pixel. Knows no
// beams.
#pragma once

#include <span>
#include <vector>

#include "render/pixel.h"
#include "render/ray_table.h"
#include "render/view.h"

namespace echoloop {

/// Fills `focus`, one for each pixel of the picture: RayTable::focus() of the ray that it shows. Pixels
/// without a surface get 1.
void find_focus(const Picture& picture, const SampleOffsets& offset, const Pose& world_from_fan,
                const RayTable& rays, std::span<const Pixel> pixels, std::vector<float>& focus);

}  // namespace echoloop
