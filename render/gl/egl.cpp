#include "render/gl/egl.h"

#include <dlfcn.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <stdexcept>

#include "render/gl/mesa_egl.h"

namespace echoloop::gl {
namespace {

EglLibrary load_system_egl() {
    void* handle = dlopen("libEGL.so.1", RTLD_NOW | RTLD_LOCAL);
    if (!handle) egl_fault(std::string("cannot load libEGL.so.1 (") + dlerror() + ")");
    return resolved_egl("libEGL.so.1", [handle](const char* symbol) { return dlsym(handle, symbol); });
}

/// Loaded once and never unloaded, as drivers' threads outlive any context.
std::shared_ptr<const EglLibrary> system_egl() {
    static const EglLibrary loaded = load_system_egl();
    return {&loaded, [](const EglLibrary*) {}};
}

class EglContext final : public Context {
  public:
    /// Displays are shared by all contexts of the process, so nobody ends them.
    EglContext(const char* kind, std::shared_ptr<const EglLibrary> lib, EGLDisplay display,
               bool draws_beside_others)
        : lib_(std::move(lib)), kind_(kind), display_(display), draws_beside_others_(draws_beside_others) {
        if (display == EGL_NO_DISPLAY || !lib_->initialize(display, nullptr, nullptr)) refuse("no display");
        if (!lib_->bind_api(EGL_OPENGL_API)) refuse("no OpenGL");
        for (const Version version : {Version{4, 5}, Version{3, 3}})
            if ((context_ = created(version)) != EGL_NO_CONTEXT) return;
        refuse("no OpenGL 3.3 core context");
    }
    ~EglContext() override {
        lib_->make_current(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        lib_->destroy_context(display_, context_);
    }

    void make_current() override {
        lib_->bind_api(EGL_OPENGL_API);
        if (!lib_->make_current(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_))
            refuse("its context cannot be bound to this thread");
    }
    Proc proc_address(const char* name) const override { return lib_->get_proc_address(name); }
    std::string_view kind() const override { return kind_; }
    bool draws_beside_others() const override { return draws_beside_others_; }

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
        return lib_->create_context(display_, config(), EGL_NO_CONTEXT, attributes.data());
    }

    /// Any that OpenGL can draw with: there is no surface, only targets of our own.
    EGLConfig config() const {
        const std::array<EGLint, 5> wanted{EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_SURFACE_TYPE, 0,
                                           EGL_NONE};
        EGLConfig found = nullptr;
        EGLint count = 0;
        if (!lib_->choose_config(display_, wanted.data(), &found, 1, &count) || count == 0)
            refuse("no configuration for OpenGL");
        return found;
    }

    [[noreturn]] void refuse(const char* what) const {
        char code[16];
        std::snprintf(code, sizeof code, "0x%04x", static_cast<unsigned>(lib_->get_error()));
        egl_fault(std::string(kind_) + " offers " + what + " (error " + code + ")");
    }

    std::shared_ptr<const EglLibrary> lib_;
    const char* kind_;
    EGLDisplay display_;
    bool draws_beside_others_;
    EGLContext context_ = EGL_NO_CONTEXT;
};

/// The first device of that sort that works, or null; what the others say goes to `refusals`.
std::unique_ptr<Context> first_device(bool hardware, std::string& refusals) {
    const auto lib = system_egl();
    for (const EGLDeviceEXT device : egl_devices(*lib)) {
        if (is_hardware(*lib, device) != hardware) continue;
        try {
            auto context = std::make_unique<EglContext>(
                gpu_kind, lib, lib->get_platform_display(EGL_PLATFORM_DEVICE_EXT, device, nullptr), false);
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
    const auto on = [](std::shared_ptr<const EglLibrary> lib, bool own) {
        const EGLDisplay display = software_display(*lib);
        return std::make_unique<EglContext>("EGL surfaceless", std::move(lib), display, own);
    };
    std::shared_ptr<const EglLibrary> mesa;
    try {
        mesa = take_mesa_egl();
    } catch (const std::runtime_error&) {  // a Mesa without GLVND, or a system that lets nothing be copied
        return on(system_egl(), false);
    }
    return on(std::move(mesa), true);
}

std::unique_ptr<Context> make_gpu_context() {
    std::string refusals;
    if (auto context = first_device(true, refusals)) return context;
    egl_fault("there is no GPU that can be used" + refusals + "; the context \"egl-surfaceless\" needs none");
}

std::unique_ptr<Context> make_egl_device_context() {
    std::string refusals;
    for (const bool hardware : {true, false})
        if (auto context = first_device(hardware, refusals)) return context;
    egl_fault("there is no device that can be used" + refusals +
              "; the context \"egl-surfaceless\" needs none");
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
