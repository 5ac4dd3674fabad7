#include <stdexcept>

#include "render/gl/context.h"
#include "render/gl/egl.h"
#include "tools/echoloop/doctor/findings.h"

namespace echoloop::cli {
namespace {

using State = Finding::State;

/// Empty if that context can be made and bound.
std::string fault_of(const char* name) {
    try {
        gl::make_context(name)->make_current();
        return "";
    } catch (const std::runtime_error& error) {
        return error.what();
    }
}

Finding gpu() {
    if (!gl::may_have_gpu()) return {State::good, "GPU", "none found; none is needed", ""};
    try {
        gl::make_gpu_context()->make_current();
        return {State::good, "GPU", "found; `render: {context: auto}` draws on it", ""};
    } catch (const std::runtime_error& error) {
        return {State::weak, "GPU", error.what(), "the processors draw instead"};
    }
}

}  // namespace

Findings look_at_graphics() {
    const std::string osmesa = fault_of("osmesa"), mesa = osmesa.empty() ? "" : fault_of("egl-surfaceless");
    Findings found;
    if (osmesa.empty())
        found.push_back({State::good, "OpenGL", "OSMesa draws in memory", ""});
    else if (mesa.empty())
        found.push_back({State::good, "OpenGL", "Mesa draws in memory, by EGL", ""});
    else if (const std::string any = fault_of("auto"); any.empty())
        found.push_back({State::weak, "OpenGL", "no Mesa draws in memory (" + mesa + ")", "the GPU draws"});
    else
        found.push_back({State::weak, "OpenGL", any, "our own rasteriser draws without it"});
    found.push_back(gpu());
    return found;
}

}  // namespace echoloop::cli
