// What is called of an EGL library, wherever it comes from.
#pragma once

#define EGL_NO_X11
#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <string>
#include <vector>

namespace echoloop::gl {

struct EglLibrary {
    decltype(&::eglGetProcAddress) get_proc_address = nullptr;
    decltype(&::eglInitialize) initialize = nullptr;
    decltype(&::eglBindAPI) bind_api = nullptr;
    decltype(&::eglChooseConfig) choose_config = nullptr;
    decltype(&::eglCreateContext) create_context = nullptr;
    decltype(&::eglDestroyContext) destroy_context = nullptr;
    decltype(&::eglMakeCurrent) make_current = nullptr;
    decltype(&::eglGetError) get_error = nullptr;
    PFNEGLGETPLATFORMDISPLAYEXTPROC get_platform_display = nullptr;
    PFNEGLQUERYDEVICESEXTPROC query_devices = nullptr;             ///< may be null
    PFNEGLQUERYDEVICESTRINGEXTPROC query_device_string = nullptr;  ///< may be null
};

/// Throws std::runtime_error that says what is wrong and names the packages to install.
[[noreturn]] void egl_fault(const std::string& what);

/// Fills the table by `address(name)`. `name`: of the library. Throws std::runtime_error.
template <typename Address>
EglLibrary resolved_egl(const char* name, const Address& address) {
    EglLibrary lib;
    const auto find = [&](const char* symbol, auto& function) {
        function = reinterpret_cast<std::decay_t<decltype(function)>>(address(symbol));
        if (!function) egl_fault(std::string(name) + " has no " + symbol);
    };
    find("eglGetProcAddress", lib.get_proc_address);
    find("eglInitialize", lib.initialize);
    find("eglBindAPI", lib.bind_api);
    find("eglChooseConfig", lib.choose_config);
    find("eglCreateContext", lib.create_context);
    find("eglDestroyContext", lib.destroy_context);
    find("eglMakeCurrent", lib.make_current);
    find("eglGetError", lib.get_error);
    const auto extension = [&lib](const char* symbol, auto& function) {
        function = reinterpret_cast<std::decay_t<decltype(function)>>(lib.get_proc_address(symbol));
    };
    extension("eglGetPlatformDisplayEXT", lib.get_platform_display);
    extension("eglQueryDevicesEXT", lib.query_devices);
    extension("eglQueryDeviceStringEXT", lib.query_device_string);
    if (!lib.get_platform_display) egl_fault(std::string(name) + " is too old to choose a platform");
    return lib;
}

std::vector<EGLDeviceEXT> egl_devices(const EglLibrary& lib);
bool is_hardware(const EglLibrary& lib, EGLDeviceEXT device);

}  // namespace echoloop::gl
