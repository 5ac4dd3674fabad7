#include "render/gl/functions.h"

#include <cstdio>
#include <stdexcept>

namespace echoloop::gl {
namespace {

template <typename Function>
void resolve(const Context& context, const char* name, Function& function) {
    function = reinterpret_cast<Function>(context.proc_address(name));
    if (!function)
        throw std::runtime_error(std::string("this OpenGL has no ") + name + "; 4.5 core is needed");
}

std::string text(const GLubyte* bytes) { return bytes ? reinterpret_cast<const char*>(bytes) : "unknown"; }

}  // namespace

Functions::Functions(const Context& context) {
#define ECHOLOOP_GL_RESOLVE(type, name) resolve(context, "gl" #name, name);
    ECHOLOOP_GL_FUNCTIONS(ECHOLOOP_GL_RESOLVE)
#undef ECHOLOOP_GL_RESOLVE
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
