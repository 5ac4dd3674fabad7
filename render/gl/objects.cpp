#include "render/gl/objects.h"

#include <stdexcept>
#include <string>

namespace echoloop::gl {
namespace {

GLuint compile(const Functions& gl, GLenum kind, const char* source) {
    const GLuint shader = gl.CreateShader(kind);
    gl.ShaderSource(shader, 1, &source, nullptr);
    gl.CompileShader(shader);
    GLint good = 0;
    gl.GetShaderiv(shader, GL_COMPILE_STATUS, &good);
    if (good) return shader;
    std::string log(4096, '\0');
    GLsizei length = 0;
    gl.GetShaderInfoLog(shader, static_cast<GLsizei>(log.size()), &length, log.data());
    gl.DeleteShader(shader);
    log.resize(static_cast<std::size_t>(length));
    throw std::runtime_error("shader does not compile: " + log);
}

}  // namespace

Program::Program(const Functions& gl, const char* vertex_source, const char* fragment_source) : gl_(gl) {
    const GLuint vertex = compile(gl, GL_VERTEX_SHADER, vertex_source);
    const GLuint fragment = compile(gl, GL_FRAGMENT_SHADER, fragment_source);
    id_ = gl.CreateProgram();
    for (const GLuint shader : {vertex, fragment}) {
        gl.AttachShader(id_, shader);
        gl.DeleteShader(shader);  // lives on while attached
    }
    gl.LinkProgram(id_);
    GLint good = 0;
    gl.GetProgramiv(id_, GL_LINK_STATUS, &good);
    if (good) return;
    std::string log(4096, '\0');
    GLsizei length = 0;
    gl.GetProgramInfoLog(id_, static_cast<GLsizei>(log.size()), &length, log.data());
    gl.DeleteProgram(id_);
    log.resize(static_cast<std::size_t>(length));
    throw std::runtime_error("shader does not link: " + log);
}

Buffer::Buffer(const Functions& gl, GLenum target, const void* data, std::size_t bytes) : gl_(gl) {
    constexpr GLenum external_memory = 0x9160;  // GL_EXTERNAL_VIRTUAL_MEMORY_BUFFER_AMD
    gl.GenBuffers(1, &id_);
    if (gl.reads_our_memory()) {
        gl.BindBuffer(external_memory, id_);
        gl.BufferData(external_memory, static_cast<GLsizeiptr>(bytes), data, GL_STATIC_DRAW);
        gl.BindBuffer(external_memory, 0);
    }
    gl.BindBuffer(target, id_);
    if (!gl.reads_our_memory()) gl.BufferData(target, static_cast<GLsizeiptr>(bytes), data, GL_STATIC_DRAW);
}

FloatTexture::FloatTexture(const Functions& gl) : gl_(gl) {
    gl.GenTextures(1, &id_);
    bind();
    for (const GLenum filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
        gl.TexParameteri(GL_TEXTURE_2D, filter, GL_LINEAR);
    for (const GLenum side : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T})
        gl.TexParameteri(GL_TEXTURE_2D, side, GL_CLAMP_TO_EDGE);
}

void FloatTexture::fill(int width, int height, const void* data) {
    bind();
    gl_.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32F, width, height, 0, GL_RGBA, GL_FLOAT, data);
}

FloatTarget::FloatTarget(const Functions& gl, int width, int height)
    : gl_(gl), width_(width), height_(height) {
    gl.GenFramebuffers(1, &framebuffer_);
    gl.GenFramebuffers(1, &empty_);
    gl.GenRenderbuffers(3, renderbuffers_);
    const auto attach = [&](GLuint framebuffer, GLenum attachment, GLuint buffer, GLenum format) {
        gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
        gl.BindRenderbuffer(GL_RENDERBUFFER, buffer);
        gl.RenderbufferStorage(GL_RENDERBUFFER, format, width, height);
        gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, attachment, GL_RENDERBUFFER, buffer);
    };
    attach(empty_, GL_COLOR_ATTACHMENT0, renderbuffers_[2], GL_RGBA32F);
    constexpr GLfloat nothing[4] = {0, 0, 0, 0};
    gl.ClearBufferfv(GL_COLOR, 0, nothing);
    attach(framebuffer_, GL_COLOR_ATTACHMENT0, renderbuffers_[0], GL_RGBA32F);
    attach(framebuffer_, GL_DEPTH_ATTACHMENT, renderbuffers_[1], GL_DEPTH_COMPONENT32F);
    if (gl.CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
        throw std::runtime_error("OpenGL refuses a float target of " + std::to_string(width) + " x " +
                                 std::to_string(height) + " pixels");
}

FloatTarget::~FloatTarget() {
    gl_.DeleteFramebuffers(1, &framebuffer_);
    gl_.DeleteFramebuffers(1, &empty_);
    gl_.DeleteRenderbuffers(3, renderbuffers_);
}

void FloatTarget::clear() const {
    bind();
    gl_.BindFramebuffer(GL_READ_FRAMEBUFFER, empty_);
    gl_.BlitFramebuffer(0, 0, width_, height_, 0, 0, width_, height_, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    bind();
    constexpr GLfloat farthest = 0;  // the depth of infinity
    gl_.ClearBufferfv(GL_DEPTH, 0, &farthest);
}

}  // namespace echoloop::gl
