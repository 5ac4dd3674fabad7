#include "render/gl/context.h"

#include <stdexcept>

#include "render/gl/egl.h"
#include "render/gl/osmesa.h"
#include "render/gl/picture_check.h"
#include "render/memory_check.h"

namespace echoloop::gl {
namespace {

using Maker = std::unique_ptr<Context> (*)();

/// Drivers of GPUs differ; Mesa's software is what the tests draw with.
template <Maker make>
std::unique_ptr<Context> checked() {
    try {
        check_picture(make());
    } catch (const std::runtime_error& error) {
        throw std::runtime_error("EGL device: " + std::string(error.what()));
    }
    return make();
}

/// The first that works of those given; else what to install, and all their complaints.
std::unique_ptr<Context> first_of(std::initializer_list<Maker> makers) {
    std::string complaints;
    for (const Maker make : makers) try {
            return make();
        } catch (const std::runtime_error& error) {
            complaints += (complaints.empty() ? "" : "; or ") + std::string(error.what());
        }
    throw std::runtime_error(
        "no OpenGL context can be made; install Mesa: apt-get install libosmesa6 or, where there is none, "
        "libegl-mesa0 libgl1-mesa-dri (" +
        complaints + ")");
}

}  // namespace

std::unique_ptr<Context> make_context(std::string_view name) {
    require_address_space();
    if (name == "osmesa") return make_osmesa_context();
    if (name == "egl-surfaceless") return make_egl_surfaceless_context();
    if (name == "egl-device") return checked<make_egl_device_context>();
    if (name != "auto")
        throw std::invalid_argument("unknown GL context \"" + std::string(name) +
                                    "\"; known are auto, osmesa, egl-surfaceless, egl-device");
    return make_auto_context(may_have_gpu());
}

std::unique_ptr<Context> make_auto_context(bool may_have_gpu) {
    if (may_have_gpu)
        return first_of({checked<make_gpu_context>, make_osmesa_context, make_egl_surfaceless_context});
    return first_of({make_osmesa_context, make_egl_surfaceless_context});
}

}  // namespace echoloop::gl
