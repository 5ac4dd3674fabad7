// The EGL implementations of Context: without any display, in memory or on a GPU. Never linked.
#pragma once

#include <memory>

#include "render/gl/context.h"

namespace echoloop::gl {

/// Mesa's software in memory, as OSMesa is; several draw at once on threads of their own. Throws
/// std::runtime_error, naming the Debian packages, when it cannot be had.
std::unique_ptr<Context> make_egl_surfaceless_context();

/// Context::kind() of contexts on a device of EGL.
inline constexpr const char* gpu_kind = "EGL device";

/// On the first EGL device that offers OpenGL 3.3, hardware before Mesa's software device. Throws
/// std::runtime_error when there is none.
std::unique_ptr<Context> make_egl_device_context();
/// The same on hardware only.
std::unique_ptr<Context> make_gpu_context();

/// False where the kernel offers no GPU at all, so that nothing need be loaded to know.
bool may_have_gpu();

}  // namespace echoloop::gl
