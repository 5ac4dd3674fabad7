// Instances of a library that draws one picture at a time, whatever the number of its contexts: a single beam
// would wait for a fan that another thread draws. So every thread that has contexts beside another's gets a
// copy of the library to itself. On one thread copies would not do: they share what is current there. They
// are never unloaded: LLVM's threads outlive any context.
#pragma once

#include <list>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <thread>

#include "render/gl/library_copy.h"

namespace echoloop::gl {

/// `Library`: what is called of one instance.
template <typename Library>
class ThreadLibraries {
  public:
    /// `load` returns what dlopen() did, `resolve` finds the functions in it; both throw std::runtime_error.
    /// `others_use_it`: who is not asked may call the library, too, so that even the first instance is a
    /// copy.
    ThreadLibraries(void* (*load)(), Library (*resolve)(void* handle), bool others_use_it)
        : load_(load), resolve_(resolve), others_use_it_(others_use_it) {}

    /// This thread's, else one that nobody uses, else a new copy; where there are none, the first. It is
    /// given back with the pointer.
    std::shared_ptr<const Library> take() {
        const std::lock_guard lock(mutex_);
        Instance& instance = instance_for(std::this_thread::get_id());
        if (instance.contexts++ == 0) instance.owner = std::this_thread::get_id();
        return {&instance.library, [this, &instance](const Library*) {
                    const std::lock_guard giving_back(mutex_);
                    --instance.contexts;
                }};
    }

  private:
    static constexpr std::size_t most = 8;
    struct Instance {
        Library library;
        std::thread::id owner{};
        std::size_t contexts = 0;
    };

    Instance& instance_for(std::thread::id thread) {
        for (Instance& instance : instances_)
            if (instance.contexts > 0 && instance.owner == thread) return instance;
        for (Instance& instance : instances_)
            if (instance.contexts == 0) return instance;
        if (first_ == nullptr) first_ = load_();
        void* const handle = instances_.empty() && !others_use_it_ ? first_
                             : instances_.size() < most            ? load_copy(first_)
                                                                   : nullptr;
        if (handle != nullptr) return instances_.emplace_back(Instance{resolve_(handle)});
        if (instances_.empty()) throw std::runtime_error("a library cannot be copied into memory");
        return instances_.front();
    }

    void* (*load_)();
    Library (*resolve_)(void* handle);
    bool others_use_it_;
    std::mutex mutex_;
    void* first_ = nullptr;
    std::list<Instance> instances_;
};

}  // namespace echoloop::gl
