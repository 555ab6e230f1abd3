#include "tools/lab/results/provenance.hpp"

#include "tools/lab/papers/commit.hpp"

namespace aisle::lab {
namespace {

std::string compiler() {
#if defined(__clang__)
  return "Clang " + std::string(__clang_version__);
#else
  return "GCC " + std::string(__VERSION__);
#endif
}

/// What the batches of samples are computed with (common/geometry/batch.hpp).
std::string vectors() {
#if !AISLE_HAS_VECTORS
  return "off";
#elif defined(__x86_64__)
  return __builtin_cpu_supports("avx2") ? "avx2" : "sse2";
#else
  return "default";
#endif
}

}  // namespace

Provenance provenance() { return {source_commit(), compiler(), AISLE_BUILD_TYPE, AISLE_BUILD_FLAGS, vectors()}; }

}  // namespace aisle::lab
