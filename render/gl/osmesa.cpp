#include "render/gl/osmesa.h"

#include <dlfcn.h>

#include <array>
#include <stdexcept>
#include <string>

#include "render/gl/thread_libraries.h"

#ifdef __has_feature  // clang
#if __has_feature(address_sanitizer)
#define __SANITIZE_ADDRESS__ 1
#endif
#endif

#ifdef __SANITIZE_ADDRESS__
// OSMesa 22.3 keeps 200 bytes of every context that it destroys; its copies in memory do so, too.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() { return "leak:libOSMesa\nleak:/proc/self/fd/"; }
#endif

namespace echoloop::gl {
namespace {

// From Mesa's osmesa.h, which cannot be included beside glcorearb.h.
constexpr int osmesa_format = 0x22, osmesa_rgba = 0x1908, osmesa_depth_bits = 0x30,
              osmesa_stencil_bits = 0x31, osmesa_profile = 0x33, osmesa_core_profile = 0x34,
              osmesa_major = 0x36, osmesa_minor = 0x37;
constexpr unsigned gl_unsigned_byte = 0x1401;

struct Library {
    void* (*create)(const int* attributes, void* share) = nullptr;
    void (*destroy)(void* context) = nullptr;
    unsigned char (*make_current)(void* context, void* buffer, unsigned type, int width,
                                  int height) = nullptr;
    Proc (*proc_address)(const char* name) = nullptr;
};

template <typename Function>
void resolve(void* handle, const char* name, Function& function) {
    function = reinterpret_cast<Function>(dlsym(handle, name));
    if (!function)
        throw std::runtime_error(std::string("libOSMesa has no ") + name +
                                 "; install libosmesa6 22.3 or newer");
}

void* load_osmesa() {
    for (const char* name : {"libOSMesa.so.8", "libOSMesa.so"})
        if (void* handle = dlopen(name, RTLD_NOW | RTLD_LOCAL)) return handle;
    throw std::runtime_error(std::string("cannot load libOSMesa (") + dlerror() +
                             "); install it with: apt-get install libosmesa6");
}

Library resolved(void* handle) {
    Library lib;
    resolve(handle, "OSMesaCreateContextAttribs", lib.create);
    resolve(handle, "OSMesaDestroyContext", lib.destroy);
    resolve(handle, "OSMesaMakeCurrent", lib.make_current);
    resolve(handle, "OSMesaGetProcAddress", lib.proc_address);
    return lib;
}

/// A dozen megabytes each.
std::shared_ptr<const Library> take_osmesa() {
    static ThreadLibraries<Library> libraries(load_osmesa, resolved, false);
    return libraries.take();
}

class OsMesaContext final : public Context {
  public:
    OsMesaContext() : lib_(take_osmesa()) {
        const std::array attributes{osmesa_format,
                                    osmesa_rgba,
                                    osmesa_depth_bits,
                                    0,
                                    osmesa_stencil_bits,
                                    0,
                                    osmesa_profile,
                                    osmesa_core_profile,
                                    osmesa_major,
                                    4,
                                    osmesa_minor,
                                    5,
                                    0};
        context_ = lib_->create(attributes.data(), nullptr);
        if (context_ == nullptr)
            throw std::runtime_error(
                "OSMesa offers no OpenGL 4.5 core context; install libosmesa6 22.3 or newer");
    }
    ~OsMesaContext() override {
        lib_->make_current(nullptr, nullptr, 0, 0, 0);
        lib_->destroy(context_);
    }

    void make_current() override {
        constexpr int side = 4;  // of the unused default framebuffer
        if (!lib_->make_current(context_, buffer_.data(), gl_unsigned_byte, side, side))
            throw std::runtime_error("OSMesa cannot bind its context to this thread");
    }
    Proc proc_address(const char* name) const override { return lib_->proc_address(name); }
    std::string_view kind() const override { return "OSMesa"; }
    bool draws_beside_others() const override { return true; }

  private:
    std::shared_ptr<const Library> lib_;
    void* context_ = nullptr;
    std::array<unsigned char, 64> buffer_{};
};

}  // namespace

std::unique_ptr<Context> make_osmesa_context() { return std::make_unique<OsMesaContext>(); }

}  // namespace echoloop::gl
