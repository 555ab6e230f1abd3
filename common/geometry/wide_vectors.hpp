#pragma once
#include <cstddef>      // and with it __GLIBC__

/// Before the definition of a function whose loops should use vectors of four doubles where the machine has them: the compiler makes
/// a second version of it for AVX2, and the loader picks one. Same results to the bit: element by element the operations are the same, and
/// AVX2 alone brings no fused multiply-add. Functions called from it take part only when they are inlined.
/// Empty elsewhere, and under sanitizers, whose run-time is not yet there when the loader asks.
#if defined(__x86_64__) && defined(__GLIBC__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define AISLE_WIDE_VECTORS __attribute__((target_clones("avx2", "default")))
#else
#define AISLE_WIDE_VECTORS
#endif
