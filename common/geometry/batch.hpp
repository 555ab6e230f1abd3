#pragma once

#include <cmath>
#include <cstddef>  // and with it __GLIBC__
#include <cstdint>

/// Put before a function that computes with batches: the compiler makes a second version of it for AVX2, where a batch
/// is one register, and the loader picks the version for its machine (GCC's function multiversioning). Functions called
/// from it take part only when they are inlined: hence [[gnu::always_inline]] on what computes with batches.
///
/// Both versions give the same results to the bit: each operation on a batch is the IEEE operation on each of its
/// numbers, and AVX2 by itself brings no fused multiply-add. The files also turn off contraction (AISLE_BATCH_OPTIONS
/// in cmake/AisleTargets.cmake), for machines whose plain instructions include it.
///
/// Empty without the CMake option AISLE_VECTORS, on other machines, and under sanitizers, whose run-time is not ready
/// when the loader picks. docs/decisions/0009-vectors-by-hand.md has the reasons and the figures.
#if defined(AISLE_VECTORS) && defined(__x86_64__) && defined(__GLIBC__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define AISLE_BATCHED __attribute__((target_clones("avx2", "default")))
#else
#define AISLE_BATCHED
#endif

// GCC warns that how a batch is returned depends on the machine. Batches cross no call: all is inlined. They are passed
// by reference, since GCC's note on passing them by value cannot be turned off here.
#pragma GCC diagnostic ignored "-Wpsabi"

namespace aisle::geometry {

/// Numbers in a batch: four doubles fill one register of AVX2 (256 bits).
inline constexpr std::size_t kBatch = 4;

/// Four numbers. + - * / and comparisons work on each of the four, as they do on four doubles; a plain number beside a
/// batch stands for four of it; `mask ? a : b` chooses for each. So a function template written for a Number computes
/// with a double (one sample) or with a Batch (four samples), with the same results.
///
/// Whatever stores batches says alignas(sizeof(Batch)): GCC aligns them to 16 bytes where it compiles without AVX, and
/// expects 32 in the versions for AVX2.
using Batch = double __attribute__((vector_size(kBatch * sizeof(double))));

/// What a comparison of batches says: -1 where it holds, else 0. & | ~ combine masks.
using BatchMask = std::int64_t __attribute__((vector_size(kBatch * sizeof(std::int64_t))));

/// Does it hold for at least one of the four (or for the one)?
[[gnu::always_inline]] inline bool any(bool mask) { return mask; }

[[gnu::always_inline]] inline bool any(const BatchMask& mask) {
  const auto either = __builtin_shufflevector(mask, mask, 0, 1) | __builtin_shufflevector(mask, mask, 2, 3);
  return (either[0] | either[1]) != 0;
}

/// In how many of the four it holds, added up over masks: of `sum += mask`.
[[gnu::always_inline]] inline int count_of(const BatchMask& sum) {
  return static_cast<int>(-(sum[0] + sum[1] + sum[2] + sum[3]));
}

/// The lesser one; `a` where they are equal.
template <class Number>
[[gnu::always_inline]] inline Number least(const Number& a, const Number& b) {
  return b < a ? b : a;
}

/// The greater one; `a` where they are equal.
template <class Number>
[[gnu::always_inline]] inline Number most(const Number& a, const Number& b) {
  return a < b ? b : a;
}

/// `value`, or the bound that it lies beyond.
template <class Number>
[[gnu::always_inline]] inline Number clamped(const Number& value, const Number& low, const Number& high) {
  return least(most(value, low), high);
}

[[gnu::always_inline]] inline Batch clamped(const Batch& value, double low, double high) {
  return clamped(value, Batch{} + low, Batch{} + high);
}

/// The number without its sign. In a batch the sign's bit of each double is cleared (IEEE 754: the
/// highest).
[[gnu::always_inline]] inline double magnitude(double a) { return std::abs(a); }

[[gnu::always_inline]] inline Batch magnitude(const Batch& a) {
  return reinterpret_cast<Batch>(reinterpret_cast<BatchMask>(a) & INT64_MAX);
}

/// The magnitude of `a` with the sign of `sign`.
[[gnu::always_inline]] inline double with_sign(double a, double sign) { return std::copysign(a, sign); }

[[gnu::always_inline]] inline Batch with_sign(const Batch& a, const Batch& sign) {
  return reinterpret_cast<Batch>((reinterpret_cast<BatchMask>(a) & INT64_MAX) |
                                 (reinterpret_cast<BatchMask>(sign) & INT64_MIN));
}

/// Rounded correctly, as IEEE 754 asks, in a batch as for one double.
[[gnu::always_inline]] inline double square_root(double a) { return std::sqrt(a); }

[[gnu::always_inline]] inline Batch square_root(const Batch& a) {
  return Batch{std::sqrt(a[0]), std::sqrt(a[1]), std::sqrt(a[2]), std::sqrt(a[3])};  // GCC makes one instruction of it
}

}  // namespace aisle::geometry
