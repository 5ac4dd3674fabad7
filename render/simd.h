// Compiles a loop for AVX-512, for AVX2 and for any x86-64; the loader picks. Never changes results where the
// file is compiled without contraction to FMA, as render/CMakeLists.txt does. The loops are plain ones: of a
// vector type wider than the processor's, g++ makes code several times slower than its own. A loop that needs
// vectors of the processor's width has one version for each, where ECHOLOOP_SIMD_VERSIONS is defined.
#pragma once

#include <cstddef>

#define ECHOLOOP_INLINE inline __attribute__((always_inline))

// Sanitizers and clang get one plain version: the resolvers run before a sanitizer is ready.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_THREAD__) && \
    !defined(__SANITIZE_ADDRESS__)
#define ECHOLOOP_SIMD_VERSIONS
#define ECHOLOOP_SIMD __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define ECHOLOOP_SIMD
#endif

namespace echoloop {

/// Four numbers that are read and reckoned with at once.
using Four = float __attribute__((vector_size(16)));
/// As many as the vectors of wider processors hold, for what is compiled for these.
using Eight [[maybe_unused]] = float __attribute__((vector_size(32)));
using Sixteen [[maybe_unused]] = float __attribute__((vector_size(64)));

constexpr std::size_t floats_per_line = 16;  ///< of the processor's cache

/// Asks for `count` floats, so that they are in the nearest cache when their turn comes; to write them, or to
/// read them. Nothing need be there.
template <bool to_write = false>
ECHOLOOP_INLINE void prefetch(const float* floats, std::size_t count) {
    for (std::size_t i = 0; i < count; i += floats_per_line) __builtin_prefetch(floats + i, to_write ? 1 : 0);
}
/// How far ahead who goes through rows asks for them, in floats: the processor's own guesses come too late
/// where little is done with each. Own choice; only this was measured.
constexpr std::size_t prefetched = 512;

/// Loops go over whole vectors of so many, so that nothing is left to be done one by one.
constexpr int whole_vector = 16;
template <typename Count>
constexpr Count padded(Count count) {
    return (count + whole_vector - 1) / whole_vector * whole_vector;
}

}  // namespace echoloop
