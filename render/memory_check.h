// Whether there is memory enough to draw at all, asked before libraries are loaded that blame other things.
#pragma once

#include <sys/mman.h>

#include <new>

namespace echoloop {

/// Memory ran out; what() is a sentence with the remedy.
class OutOfMemory : public std::bad_alloc {
  public:
    explicit OutOfMemory(const char* sentence) : sentence_(sentence) {}
    const char* what() const noexcept override { return sentence_; }

  private:
    const char* sentence_;
};

/// Mesa with its compiler, Embree and their threads map some 700 MiB, a quarter of which is ever used. Below
/// that they fail in ways that name no memory, or die. Throws OutOfMemory.
inline void require_address_space() {
    constexpr std::size_t needed = std::size_t{720} << 20;
    void* const room = ::mmap(nullptr, needed, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    if (room == MAP_FAILED)
        throw OutOfMemory(
            "not enough memory: drawing maps 720 MiB, and this process may not map so much more; raise the "
            "limit of "
            "its address space, e.g. with ulimit -v unlimited");
    ::munmap(room, needed);
}

}  // namespace echoloop
