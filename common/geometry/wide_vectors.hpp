#pragma once
#include <cstddef>  // and with it __GLIBC__
#include <cstdint>
#include <cstring>

/// Before the definition of a function whose loops should use vectors of four doubles where the machine has them: the
/// compiler makes a second version of it for AVX2, and the loader picks one. Same results to the bit: element by
/// element the operations are the same, and AVX2 alone brings no fused multiply-add. Functions called from it take part
/// only when they are inlined. Empty elsewhere, and under sanitizers, whose run-time is not yet there when the loader
/// asks.
#if defined(__x86_64__) && defined(__GLIBC__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define AISLE_WIDE_VECTORS __attribute__((target_clones("avx2", "default")))
#else
#define AISLE_WIDE_VECTORS
#endif

namespace aisle::geometry {

/// Four numbers, added, compared and chosen from (`marks ? a : b`) one by one: for steps that should stay in registers
/// from end to end, which compilers do not make of loops. Where the machine's vectors are shorter they take two for
/// one. References only in arguments: how values are passed depends on the machine.
inline constexpr std::size_t kWide = 4;
using Wide = double __attribute__((vector_size(32)));
using WideMarks = std::int64_t __attribute__((vector_size(32)));  // -1 where it holds, else 0

[[gnu::always_inline]] inline void load(const double* from, Wide& to) { std::memcpy(&to, from, sizeof(to)); }
[[gnu::always_inline]] inline void load(const std::int64_t* from, WideMarks& to) { std::memcpy(&to, from, sizeof(to)); }
[[gnu::always_inline]] inline void store(const Wide& from, double* to) { std::memcpy(to, &from, sizeof(from)); }
[[gnu::always_inline]] inline void store(const WideMarks& from, std::int64_t* to) {
  std::memcpy(to, &from, sizeof(from));
}
[[gnu::always_inline]] inline bool is_any(const WideMarks& marks) {
  const auto either = __builtin_shufflevector(marks, marks, 0, 1) | __builtin_shufflevector(marks, marks, 2, 3);
  return (either[0] | either[1]) != 0;
}

}  // namespace aisle::geometry
