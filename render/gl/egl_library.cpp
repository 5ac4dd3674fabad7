#include "render/gl/egl_library.h"

#include <stdexcept>
#include <string_view>

namespace echoloop::gl {

void egl_fault(const std::string& what) {
    throw std::runtime_error(
        "EGL: " + what +
        "; for Mesa's install: apt-get install libegl1 libegl-mesa0 libgl1-mesa-dri; for "
        "another GPU driver its own EGL library");
}

std::vector<EGLDeviceEXT> egl_devices(const EglLibrary& lib) {
    EGLint count = 0;
    if (!lib.query_devices || !lib.query_device_string || !lib.query_devices(0, nullptr, &count)) return {};
    std::vector<EGLDeviceEXT> out(static_cast<std::size_t>(count));
    if (!lib.query_devices(count, out.data(), &count)) return {};
    out.resize(static_cast<std::size_t>(count));
    return out;
}

bool is_hardware(const EglLibrary& lib, EGLDeviceEXT device) {
    const char* extensions = lib.query_device_string(device, EGL_EXTENSIONS);
    return extensions &&
           std::string_view(extensions).find("EGL_MESA_device_software") == std::string_view::npos;
}

}  // namespace echoloop::gl
