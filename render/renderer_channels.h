// The image of Cerqueira et al. 2016 out of a picture.
#pragma once

#include <span>

#include "render/fan/plan.h"
#include "render/pixel.h"
#include "render/renderer.h"

namespace echoloop {

ChannelImage channels_of(const FanPlan& plan, std::span<const Pixel> pixels);

}  // namespace echoloop
