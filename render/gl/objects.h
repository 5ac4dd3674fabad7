// Owners of GL objects: each deletes what it made. The context must be current whenever they are made, used
// or die.
#pragma once

#include <cstddef>

#include "render/gl/functions.h"

namespace echoloop::gl {

/// A linked vertex and fragment shader.
class Program {
  public:
    /// Throws std::runtime_error with the compiler's log.
    Program(const Functions& gl, const char* vertex_source, const char* fragment_source);
    Program(const Program&) = delete;
    Program& operator=(const Program&) = delete;
    ~Program() { gl_.DeleteProgram(id_); }

    void use() const { gl_.UseProgram(id_); }
    GLint uniform(const char* name) const { return gl_.GetUniformLocation(id_, name); }

  private:
    const Functions& gl_;
    GLuint id_;
};

/// An immutable buffer of vertices or indices.
class Buffer {
  public:
    /// `data` must live as long: a rasteriser in this process reads it where it lies. Others have a copy.
    Buffer(const Functions& gl, GLenum target, const void* data, std::size_t bytes);
    Buffer(const Buffer&) = delete;
    Buffer& operator=(const Buffer&) = delete;
    ~Buffer() { gl_.DeleteBuffers(1, &id_); }

  private:
    const Functions& gl_;
    GLuint id_ = 0;
};

class VertexArray {
  public:
    explicit VertexArray(const Functions& gl) : gl_(gl) {
        gl_.GenVertexArrays(1, &id_);
        bind();
    }
    VertexArray(const VertexArray&) = delete;
    VertexArray& operator=(const VertexArray&) = delete;
    ~VertexArray() { gl_.DeleteVertexArrays(1, &id_); }

    void bind() const { gl_.BindVertexArray(id_); }

  private:
    const Functions& gl_;
    GLuint id_ = 0;
};

/// A table of four 32-bit floats in each cell, linear between them.
class FloatTexture {
  public:
    explicit FloatTexture(const Functions& gl);
    FloatTexture(const FloatTexture&) = delete;
    FloatTexture& operator=(const FloatTexture&) = delete;
    ~FloatTexture() { gl_.DeleteTextures(1, &id_); }

    void bind() const { gl_.BindTexture(GL_TEXTURE_2D, id_); }
    /// Copies `data`, row by row.
    void fill(int width, int height, const void* data);

  private:
    const Functions& gl_;
    GLuint id_ = 0;
};

/// An off-screen target of four 32-bit floats per pixel and 32-bit float depth.
class FloatTarget {
  public:
    /// Throws std::runtime_error when GL refuses the size.
    FloatTarget(const Functions& gl, int width, int height);
    FloatTarget(const FloatTarget&) = delete;
    FloatTarget& operator=(const FloatTarget&) = delete;
    ~FloatTarget();

    void bind() const { gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_); }
    /// All zeros; binds it. The colours are copied from an empty twin, as llvmpipe copies whole rows, but
    /// clears 16-byte pixels one by one.
    void clear() const;

  private:
    const Functions& gl_;
    int width_, height_;
    GLuint framebuffer_ = 0, empty_ = 0;
    GLuint renderbuffers_[3]{};  ///< colours, depth, the twin's colours
};

}  // namespace echoloop::gl
