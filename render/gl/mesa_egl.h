// Mesa's own EGL, loaded past the libEGL.so.1 that chooses among makers: that one would give all threads the
// same Mesa, whose contexts draw one after the other.
#pragma once

#include <memory>

#include "render/gl/egl_library.h"

namespace echoloop::gl {

/// The instance of this thread, for a context that it makes; see ThreadLibraries. Throws std::runtime_error
/// where Mesa's EGL cannot be loaded, or not by itself.
std::shared_ptr<const EglLibrary> take_mesa_egl();

/// A display of it that draws in software and opens no device: on its surfaceless platform it would take a
/// GPU where there is one, right or wrong.
EGLDisplay software_display(const EglLibrary& mesa);

}  // namespace echoloop::gl
