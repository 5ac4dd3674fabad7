// Compiles a loop for AVX-512, for AVX2 and for any x86-64; the loader picks. Never changes results where the file is
// compiled without contraction to FMA, as render/CMakeLists.txt does.
#pragma once

// Sanitizers and clang get one plain version: the resolvers run before a sanitizer is ready.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_THREAD__) && \
    !defined(__SANITIZE_ADDRESS__)
#define ECHOLOOP_SIMD __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define ECHOLOOP_SIMD
#endif
