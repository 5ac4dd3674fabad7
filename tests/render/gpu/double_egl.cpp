// TEST DOUBLE of libEGL, since a GPU is not to be had on every machine: the system's own EGL with Mesa's
// software device passed off as hardware, or with a broken GPU before it. What it draws is drawn by Mesa.
// ECHOLOOP_DOUBLE_EGL says which: "gpu", "wrong" for one whose ranges are a thousandth too long, "broken", or
// anything else for the system's devices as they are.
#define EGL_NO_X11
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GL/gl.h>
#include <dlfcn.h>

#include <cstdlib>
#include <cstring>
#include <string_view>

namespace {

template <typename Function>
Function real(const char* name) {
    static void* const library = dlopen(ECHOLOOP_SYSTEM_EGL, RTLD_NOW | RTLD_LOCAL);
    return library ? reinterpret_cast<Function>(dlsym(library, name)) : nullptr;
}

template <typename Function>
Function real_extension(const char* name) {
    return reinterpret_cast<Function>(real<decltype(&eglGetProcAddress)>("eglGetProcAddress")(name));
}

bool pretends(std::string_view what) {
    const char* wish = std::getenv("ECHOLOOP_DOUBLE_EGL");
    return wish && wish == what;
}

int broken_gpu;  // its address is the device

EGLBoolean query_devices(EGLint most, EGLDeviceEXT* devices, EGLint* count) {
    const auto system = real_extension<PFNEGLQUERYDEVICESEXTPROC>("eglQueryDevicesEXT");
    if (!pretends("broken")) return system(most, devices, count);
    if (!devices) {
        const EGLBoolean done = system(0, nullptr, count);
        ++*count;
        return done;
    }
    devices[0] = &broken_gpu;
    const EGLBoolean done = system(most - 1, devices + 1, count);
    ++*count;
    return done;
}

const char* query_device_string(EGLDeviceEXT device, EGLint name) {
    if (device == &broken_gpu || pretends("gpu") || pretends("wrong")) return "EGL_EXT_device_drm";
    return real_extension<PFNEGLQUERYDEVICESTRINGEXTPROC>("eglQueryDeviceStringEXT")(device, name);
}

EGLDisplay get_platform_display(EGLenum platform, void* device, const EGLint* attributes) {
    if (device == &broken_gpu) return EGL_NO_DISPLAY;
    return real_extension<PFNEGLGETPLATFORMDISPLAYEXTPROC>("eglGetPlatformDisplayEXT")(platform, device,
                                                                                       attributes);
}

void read_wrongly(GLint x, GLint y, GLsizei width, GLsizei height, GLenum format, GLenum type, void* pixels) {
    using Read = void (*)(GLint, GLint, GLsizei, GLsizei, GLenum, GLenum, void*);
    real_extension<Read>("glReadPixels")(x, y, width, height, format, type, pixels);
    for (GLsizei i = 0; i < width * height; ++i) static_cast<float*>(pixels)[4 * i] *= 1.001F;
}

}  // namespace

extern "C" {

__eglMustCastToProperFunctionPointerType eglGetProcAddress(const char* name) {
    using Any = __eglMustCastToProperFunctionPointerType;
    if (!std::strcmp(name, "eglQueryDevicesEXT")) return reinterpret_cast<Any>(query_devices);
    if (!std::strcmp(name, "eglQueryDeviceStringEXT")) return reinterpret_cast<Any>(query_device_string);
    if (!std::strcmp(name, "eglGetPlatformDisplayEXT")) return reinterpret_cast<Any>(get_platform_display);
    if (!std::strcmp(name, "glReadPixels") && pretends("wrong")) return reinterpret_cast<Any>(read_wrongly);
    return real<decltype(&eglGetProcAddress)>("eglGetProcAddress")(name);
}
EGLBoolean eglInitialize(EGLDisplay display, EGLint* major, EGLint* minor) {
    return real<decltype(&eglInitialize)>("eglInitialize")(display, major, minor);
}
EGLBoolean eglBindAPI(EGLenum api) { return real<decltype(&eglBindAPI)>("eglBindAPI")(api); }
EGLBoolean eglChooseConfig(EGLDisplay display, const EGLint* wanted, EGLConfig* found, EGLint most,
                           EGLint* count) {
    return real<decltype(&eglChooseConfig)>("eglChooseConfig")(display, wanted, found, most, count);
}
EGLContext eglCreateContext(EGLDisplay display, EGLConfig config, EGLContext shared,
                            const EGLint* attributes) {
    return real<decltype(&eglCreateContext)>("eglCreateContext")(display, config, shared, attributes);
}
EGLBoolean eglDestroyContext(EGLDisplay display, EGLContext context) {
    return real<decltype(&eglDestroyContext)>("eglDestroyContext")(display, context);
}
EGLBoolean eglMakeCurrent(EGLDisplay display, EGLSurface draw, EGLSurface read, EGLContext context) {
    return real<decltype(&eglMakeCurrent)>("eglMakeCurrent")(display, draw, read, context);
}
EGLint eglGetError() { return real<decltype(&eglGetError)>("eglGetError")(); }
}
