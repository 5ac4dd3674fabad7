// Loops over a mesh's vertices or triangles, shared out among threads where it is large. What a loop does for
// one number must not depend on the others.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>

#include "render/workers.h"

namespace echoloop {

/// One of `shares` parts of the numbers below a count.
struct Share {
    std::uint32_t first, last;  ///< the last one is not in it

    Share(std::size_t share, std::size_t shares, std::size_t count)
        : first(static_cast<std::uint32_t>(share * count / shares)),
          last(static_cast<std::uint32_t>((share + 1) * count / shares)) {}
    bool has(std::uint32_t number) const { return number - first < last - first; }
};

class MeshLoops {
  public:
    explicit MeshLoops(std::size_t size)
        : threads_(size < worth_a_thread ? 1 : Workers::useful()), workers_(threads_) {}

    std::size_t threads() const { return threads_; }

    /// Calls work(i) for every i below `count`.
    template <typename Work>
    void each(std::size_t count, const Work& work) {
        constexpr std::size_t block = 8192;
        workers_.run((count + block - 1) / block, [&](std::size_t b) {
            const std::size_t end = std::min(count, (b + 1) * block);
            for (std::size_t i = b * block; i < end; ++i) work(i);
        });
    }

    /// Whether is(i) is true for any i below `count`.
    template <typename Is>
    bool any(std::size_t count, const Is& is) {
        std::atomic<bool> found = false;
        each(count, [&](std::size_t i) {
            if (is(i)) found = true;
        });
        return found;
    }

    /// Calls work(part) for every part below `parts`, each of them on one thread.
    template <typename Work>
    void parts(std::size_t parts, const Work& work) {
        workers_.run(parts, work);
    }

  private:
    static constexpr std::size_t worth_a_thread = 20'000;

    std::size_t threads_;
    Workers workers_;
};

}  // namespace echoloop
