#include "render/gl/egl.h"

#include <dlfcn.h>

#define EGL_NO_X11
#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <stdexcept>
#include <vector>

namespace echoloop::gl {
namespace {

constexpr const char* mesa_packages = "apt-get install libegl1 libegl-mesa0 libgl1-mesa-dri";

[[noreturn]] void fail(const std::string& what) {
    throw std::runtime_error("EGL: " + what + "; for Mesa's install: " + mesa_packages +
                             "; for another GPU driver its own EGL library");
}

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

template <typename Function>
void resolve_egl(void* handle, const char* name, Function& function) {
    function = reinterpret_cast<Function>(dlsym(handle, name));
    if (!function) fail(std::string("libEGL.so.1 has no ") + name);
}

EglLibrary load() {
    void* handle = dlopen("libEGL.so.1", RTLD_NOW | RTLD_LOCAL);
    if (!handle) fail(std::string("cannot load libEGL.so.1 (") + dlerror() + ")");
    EglLibrary lib;
    resolve_egl(handle, "eglGetProcAddress", lib.get_proc_address);
    resolve_egl(handle, "eglInitialize", lib.initialize);
    resolve_egl(handle, "eglBindAPI", lib.bind_api);
    resolve_egl(handle, "eglChooseConfig", lib.choose_config);
    resolve_egl(handle, "eglCreateContext", lib.create_context);
    resolve_egl(handle, "eglDestroyContext", lib.destroy_context);
    resolve_egl(handle, "eglMakeCurrent", lib.make_current);
    resolve_egl(handle, "eglGetError", lib.get_error);
    const auto extension = [&lib](const char* name, auto& function) {
        function = reinterpret_cast<std::decay_t<decltype(function)>>(lib.get_proc_address(name));
    };
    extension("eglGetPlatformDisplayEXT", lib.get_platform_display);
    extension("eglQueryDevicesEXT", lib.query_devices);
    extension("eglQueryDeviceStringEXT", lib.query_device_string);
    if (!lib.get_platform_display) fail("libEGL.so.1 is too old to choose a platform");
    return lib;
}

/// Loaded once and never unloaded, as drivers' threads outlive any context.
const EglLibrary& library() {
    static const EglLibrary loaded = load();
    return loaded;
}

class EglContext final : public Context {
  public:
    /// Displays are shared by all contexts of the process, so nobody ends them.
    EglContext(const char* kind, EGLDisplay display) : lib_(library()), kind_(kind), display_(display) {
        if (display == EGL_NO_DISPLAY || !lib_.initialize(display, nullptr, nullptr)) refuse("no display");
        if (!lib_.bind_api(EGL_OPENGL_API)) refuse("no OpenGL");
        for (const Version version : {Version{4, 5}, Version{3, 3}})
            if ((context_ = created(version)) != EGL_NO_CONTEXT) return;
        refuse("no OpenGL 3.3 core context");
    }
    ~EglContext() override {
        lib_.make_current(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        lib_.destroy_context(display_, context_);
    }

    void make_current() override {
        lib_.bind_api(EGL_OPENGL_API);
        if (!lib_.make_current(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_))
            refuse("its context cannot be bound to this thread");
    }
    Proc proc_address(const char* name) const override { return lib_.get_proc_address(name); }
    std::string_view kind() const override { return kind_; }

  private:
    struct Version {
        EGLint major, minor;
    };

    EGLContext created(Version version) const {
        const std::array<EGLint, 7> attributes{EGL_CONTEXT_MAJOR_VERSION,
                                               version.major,
                                               EGL_CONTEXT_MINOR_VERSION,
                                               version.minor,
                                               EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                               EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                               EGL_NONE};
        return lib_.create_context(display_, config(), EGL_NO_CONTEXT, attributes.data());
    }

    /// Any that OpenGL can draw with: there is no surface, only targets of our own.
    EGLConfig config() const {
        const std::array<EGLint, 5> wanted{EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_SURFACE_TYPE, 0,
                                           EGL_NONE};
        EGLConfig found = nullptr;
        EGLint count = 0;
        if (!lib_.choose_config(display_, wanted.data(), &found, 1, &count) || count == 0)
            refuse("no configuration for OpenGL");
        return found;
    }

    [[noreturn]] void refuse(const char* what) const {
        char code[16];
        std::snprintf(code, sizeof code, "0x%04x", static_cast<unsigned>(lib_.get_error()));
        fail(std::string(kind_) + " offers " + what + " (error " + code + ")");
    }

    const EglLibrary& lib_;
    const char* kind_;
    EGLDisplay display_;
    EGLContext context_ = EGL_NO_CONTEXT;
};

std::vector<EGLDeviceEXT> devices(const EglLibrary& lib) {
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

/// The first device of that sort that works, or null; what the others say goes to `refusals`.
std::unique_ptr<Context> first_device(bool hardware, std::string& refusals) {
    const EglLibrary& lib = library();
    for (const EGLDeviceEXT device : devices(lib)) {
        if (is_hardware(lib, device) != hardware) continue;
        try {
            auto context = std::make_unique<EglContext>(
                "EGL device", lib.get_platform_display(EGL_PLATFORM_DEVICE_EXT, device, nullptr));
            context->make_current();  // some offer what they then cannot do
            return context;
        } catch (const std::runtime_error& error) {
            refusals += std::string(" (") + error.what() + ")";
        }
    }
    return nullptr;
}

}  // namespace

std::unique_ptr<Context> make_egl_surfaceless_context() {
    return std::make_unique<EglContext>(
        "EGL surfaceless",
        library().get_platform_display(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr));
}

std::unique_ptr<Context> make_gpu_context() {
    std::string refusals;
    if (auto context = first_device(true, refusals)) return context;
    fail("there is no GPU that can be used" + refusals + "; the context \"osmesa\" needs none");
}

std::unique_ptr<Context> make_egl_device_context() {
    std::string refusals;
    for (const bool hardware : {true, false})
        if (auto context = first_device(hardware, refusals)) return context;
    fail("there is no device that can be used" + refusals + "; the context \"osmesa\" needs none");
}

bool may_have_gpu() {
    namespace fs = std::filesystem;
    std::error_code ignored;
    for (const char* node : {"/dev/nvidia0", "/dev/dxg"})
        if (fs::exists(node, ignored)) return true;
    for (const auto& entry : fs::directory_iterator("/dev/dri", ignored))
        if (entry.path().filename().string().starts_with("renderD")) return true;
    return false;
}

}  // namespace echoloop::gl
