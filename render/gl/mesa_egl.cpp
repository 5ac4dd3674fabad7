#include "render/gl/mesa_egl.h"

#include <dlfcn.h>
#include <glvnd/libeglabi.h>

#include "render/gl/thread_libraries.h"

namespace echoloop::gl {
namespace {

constexpr const char* mesa_egl_name = "libEGL_mesa.so.0";

void* load_mesa_egl() {
    void* handle = ::dlopen(mesa_egl_name, RTLD_NOW | RTLD_LOCAL);
    if (!handle) egl_fault(std::string("cannot load ") + mesa_egl_name + " (" + ::dlerror() + ")");
    return handle;
}

/// By the interface that libEGL.so.1 of GLVND uses of each maker's library. What we would export is for
/// functions that are called through GLVND, which nothing is here: an instance that GLVND uses would lose its
/// own exports by this.
EglLibrary resolved_mesa_egl(void* handle) {
    const auto main = reinterpret_cast<__PFNEGLMAINPROC>(::dlsym(handle, __EGL_MAIN_PROTO_NAME));
    static const __EGLapiExports exports{};
    __EGLapiImports imports{};
    if (!main || !main(EGL_VENDOR_ABI_VERSION, &exports, nullptr, &imports) || !imports.getProcAddress)
        egl_fault(std::string(mesa_egl_name) + " does not speak GLVND's interface of version " +
                  std::to_string(EGL_VENDOR_ABI_MAJOR_VERSION));
    return resolved_egl(mesa_egl_name, imports.getProcAddress);
}

}  // namespace

std::shared_ptr<const EglLibrary> take_mesa_egl() {
    static ThreadLibraries<EglLibrary> libraries(load_mesa_egl, resolved_mesa_egl, true);
    return libraries.take();
}

EGLDisplay software_display(const EglLibrary& mesa) {
    for (const EGLDeviceEXT device : egl_devices(mesa))
        if (!is_hardware(mesa, device))
            return mesa.get_platform_display(EGL_PLATFORM_DEVICE_EXT, device, nullptr);
    return mesa.get_platform_display(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
}

}  // namespace echoloop::gl
