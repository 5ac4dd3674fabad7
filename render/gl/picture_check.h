// Whether a context draws what it should: asked of GPUs before they are believed, since drivers differ.
#pragma once

#include <memory>

#include "render/gl/context.h"

namespace echoloop::gl {

/// Draws two walls, one before the other, of which every pixel is known in closed form. Throws
/// std::runtime_error that says what differs and where. Uses the context up.
void check_picture(std::unique_ptr<Context> context);

}  // namespace echoloop::gl
