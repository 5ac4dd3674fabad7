// An off-screen OpenGL core context (Functions says which will do) behind a small interface. Belongs to the
// thread that makes it current; never opens a window and is never linked, only loaded at run time.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace echoloop::gl {

using Proc = void (*)();

class Context {
  public:
    Context() = default;
    Context(const Context&) = delete;
    Context& operator=(const Context&) = delete;
    virtual ~Context() = default;

    /// Binds the context to the calling thread. Throws std::runtime_error when the library refuses.
    virtual void make_current() = 0;
    /// Address of a GL entry point, or null.
    virtual Proc proc_address(const char* name) const = 0;
    /// Name of the kind of context, for example "OSMesa".
    virtual std::string_view kind() const = 0;
    /// Whether it is worth while to draw one picture with two of them, on two threads: not where a GPU or a
    /// lock serves one after the other.
    virtual bool draws_beside_others() const { return false; }
};

/// Makes a context of the named kind: "osmesa", "egl-surfaceless", "egl-device" (a GPU), or "auto": a GPU
/// where there is one that draws a known picture rightly (check_picture()), else OSMesa, else EGL
/// surfaceless. Throws std::invalid_argument for an unknown name, and std::runtime_error naming the package
/// to install when none can be made, OutOfMemory where there is too little of it.
std::unique_ptr<Context> make_context(std::string_view name);
/// What "auto" makes; `may_have_gpu`: whether looking for a GPU is worth loading EGL.
std::unique_ptr<Context> make_auto_context(bool may_have_gpu);

}  // namespace echoloop::gl
