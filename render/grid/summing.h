// From a picture to received power per beam and bin of rows of beams (Shot::elevations).
#pragma once

#include "render/fan/summing.h"

namespace echoloop {

std::unique_ptr<Summing> make_grid_summing(Workers& workers);

}  // namespace echoloop
