// The GL entry points that the renderer calls, resolved once per context. Knows no window system.
#pragma once

#include <GL/glcorearb.h>

#include <string>

#include "render/gl/context.h"

namespace echoloop::gl {

// X(type, name): one member `name` of type `type`, resolved from "gl" #name.
#define ECHOLOOP_GL_FUNCTIONS(X)                                         \
    X(PFNGLATTACHSHADERPROC, AttachShader)                               \
    X(PFNGLBINDBUFFERPROC, BindBuffer)                                   \
    X(PFNGLBINDFRAMEBUFFERPROC, BindFramebuffer)                         \
    X(PFNGLBINDRENDERBUFFERPROC, BindRenderbuffer)                       \
    X(PFNGLBINDTEXTUREPROC, BindTexture)                                 \
    X(PFNGLBINDVERTEXARRAYPROC, BindVertexArray)                         \
    X(PFNGLBLITFRAMEBUFFERPROC, BlitFramebuffer)                         \
    X(PFNGLBUFFERDATAPROC, BufferData)                                   \
    X(PFNGLCHECKFRAMEBUFFERSTATUSPROC, CheckFramebufferStatus)           \
    X(PFNGLCLEARBUFFERFVPROC, ClearBufferfv)                             \
    X(PFNGLCLIPCONTROLPROC, ClipControl)                                 \
    X(PFNGLCOMPILESHADERPROC, CompileShader)                             \
    X(PFNGLCREATEPROGRAMPROC, CreateProgram)                             \
    X(PFNGLCREATESHADERPROC, CreateShader)                               \
    X(PFNGLDELETEBUFFERSPROC, DeleteBuffers)                             \
    X(PFNGLDELETEFRAMEBUFFERSPROC, DeleteFramebuffers)                   \
    X(PFNGLDELETEPROGRAMPROC, DeleteProgram)                             \
    X(PFNGLDELETERENDERBUFFERSPROC, DeleteRenderbuffers)                 \
    X(PFNGLDELETESHADERPROC, DeleteShader)                               \
    X(PFNGLDELETETEXTURESPROC, DeleteTextures)                           \
    X(PFNGLDELETEVERTEXARRAYSPROC, DeleteVertexArrays)                   \
    X(PFNGLDEPTHFUNCPROC, DepthFunc)                                     \
    X(PFNGLDISABLEPROC, Disable)                                         \
    X(PFNGLENABLEPROC, Enable)                                           \
    X(PFNGLENABLEVERTEXATTRIBARRAYPROC, EnableVertexAttribArray)         \
    X(PFNGLFINISHPROC, Finish)                                           \
    X(PFNGLFRAMEBUFFERRENDERBUFFERPROC, FramebufferRenderbuffer)         \
    X(PFNGLGENBUFFERSPROC, GenBuffers)                                   \
    X(PFNGLGENFRAMEBUFFERSPROC, GenFramebuffers)                         \
    X(PFNGLGENRENDERBUFFERSPROC, GenRenderbuffers)                       \
    X(PFNGLGENTEXTURESPROC, GenTextures)                                 \
    X(PFNGLGENVERTEXARRAYSPROC, GenVertexArrays)                         \
    X(PFNGLGETERRORPROC, GetError)                                       \
    X(PFNGLGETINTEGERVPROC, GetIntegerv)                                 \
    X(PFNGLGETPROGRAMINFOLOGPROC, GetProgramInfoLog)                     \
    X(PFNGLGETPROGRAMIVPROC, GetProgramiv)                               \
    X(PFNGLGETSHADERINFOLOGPROC, GetShaderInfoLog)                       \
    X(PFNGLGETSHADERIVPROC, GetShaderiv)                                 \
    X(PFNGLGETSTRINGPROC, GetString)                                     \
    X(PFNGLGETSTRINGIPROC, GetStringi)                                   \
    X(PFNGLGETUNIFORMLOCATIONPROC, GetUniformLocation)                   \
    X(PFNGLLINKPROGRAMPROC, LinkProgram)                                 \
    X(PFNGLMULTIDRAWELEMENTSBASEVERTEXPROC, MultiDrawElementsBaseVertex) \
    X(PFNGLPIXELSTOREIPROC, PixelStorei)                                 \
    X(PFNGLREADPIXELSPROC, ReadPixels)                                   \
    X(PFNGLRENDERBUFFERSTORAGEPROC, RenderbufferStorage)                 \
    X(PFNGLSHADERSOURCEPROC, ShaderSource)                               \
    X(PFNGLTEXIMAGE2DPROC, TexImage2D)                                   \
    X(PFNGLTEXPARAMETERIPROC, TexParameteri)                             \
    X(PFNGLUNIFORM2FPROC, Uniform2f)                                     \
    X(PFNGLUNIFORM3FPROC, Uniform3f)                                     \
    X(PFNGLUNIFORM4FPROC, Uniform4f)                                     \
    X(PFNGLUNIFORMMATRIX3FVPROC, UniformMatrix3fv)                       \
    X(PFNGLUSEPROGRAMPROC, UseProgram)                                   \
    X(PFNGLVERTEXATTRIBPOINTERPROC, VertexAttribPointer)                 \
    X(PFNGLVIEWPORTPROC, Viewport)

struct Functions {
#define ECHOLOOP_GL_MEMBER(type, name) type name = nullptr;
    ECHOLOOP_GL_FUNCTIONS(ECHOLOOP_GL_MEMBER)
#undef ECHOLOOP_GL_MEMBER

    /// The context must be current. Throws std::runtime_error naming what is missing, unless it is of OpenGL
    /// 4.5, or of 3.3 with GL_ARB_clip_control (GPUs of virtual machines).
    explicit Functions(const Context& context);

    /// Version and renderer, for example "4.5 (Core Profile) Mesa 22.3.6, llvmpipe (LLVM 15.0.6, 256 bits)".
    std::string description() const;
    /// Whether buffers may be our own memory at no cost: a rasteriser on the processor with
    /// GL_AMD_pinned_memory. A GPU would fetch each vertex over the bus.
    bool reads_our_memory() const { return reads_our_memory_; }
    /// Throws std::runtime_error if GL has recorded an error since the last call; `where` goes into the
    /// message.
    void check(const char* where) const;

  private:
    bool reads_our_memory_ = false;
};

}  // namespace echoloop::gl
