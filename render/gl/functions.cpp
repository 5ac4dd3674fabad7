#include "render/gl/functions.h"

#include <cstdio>
#include <stdexcept>

namespace echoloop::gl {
namespace {

constexpr const char* needed = "4.5 core is needed, or 3.3 with GL_ARB_clip_control";

template <typename Function>
void resolve(const Context& context, const char* name, Function& function) {
    function = reinterpret_cast<Function>(context.proc_address(name));
    if (!function) throw std::runtime_error(std::string("this OpenGL has no ") + name + "; " + needed);
}

std::string text(const GLubyte* bytes) { return bytes ? reinterpret_cast<const char*>(bytes) : "unknown"; }

bool has_extension(const Functions& gl, const char* name) {
    GLint extensions = 0;
    gl.GetIntegerv(GL_NUM_EXTENSIONS, &extensions);
    for (GLint i = 0; i < extensions; ++i)
        if (text(gl.GetStringi(GL_EXTENSIONS, static_cast<GLuint>(i))) == name) return true;
    return false;
}

/// Drivers have addresses even for what they cannot do.
bool can_set_depth_range(const Functions& gl) {
    GLint major = 0, minor = 0;
    gl.GetIntegerv(GL_MAJOR_VERSION, &major);
    gl.GetIntegerv(GL_MINOR_VERSION, &minor);
    return major > 4 || (major == 4 && minor >= 5) || has_extension(gl, "GL_ARB_clip_control");
}

}  // namespace

Functions::Functions(const Context& context) {
#define ECHOLOOP_GL_RESOLVE(type, name) resolve(context, "gl" #name, name);
    ECHOLOOP_GL_FUNCTIONS(ECHOLOOP_GL_RESOLVE)
#undef ECHOLOOP_GL_RESOLVE
    if (!can_set_depth_range(*this))
        throw std::runtime_error("OpenGL " + description() + " cannot set its range of depths; " + needed);
    reads_our_memory_ = text(GetString(GL_RENDERER)).find("llvmpipe") != std::string::npos &&
                        has_extension(*this, "GL_AMD_pinned_memory");
}

std::string Functions::description() const {
    return text(GetString(GL_VERSION)) + ", " + text(GetString(GL_RENDERER));
}

void Functions::check(const char* where) const {
    const GLenum error = GetError();
    if (error == GL_NO_ERROR) return;
    char code[16];
    std::snprintf(code, sizeof code, "0x%04x", error);
    throw std::runtime_error(std::string("OpenGL error ") + code + " in " + where);
}

}  // namespace echoloop::gl
