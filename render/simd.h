// Compiles a loop twice, for processors with AVX2 and FMA and for all others, and picks at run time.
#pragma once

// Sanitizers do not go with the resolver that picks the version, and clang before 14 knows no such attribute.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_THREAD__) && \
    !defined(__SANITIZE_ADDRESS__)
#define ECHOLOOP_SIMD __attribute__((target_clones("arch=x86-64-v3", "default")))
#else
#define ECHOLOOP_SIMD
#endif
