// The OSMesa implementation of Context: llvmpipe in memory, no display and no device. Never linked.
#pragma once

#include <memory>

#include "render/gl/context.h"

namespace echoloop::gl {

/// Throws std::runtime_error, naming the Debian package, when libOSMesa cannot be loaded or is too old.
std::unique_ptr<Context> make_osmesa_context();

}  // namespace echoloop::gl
