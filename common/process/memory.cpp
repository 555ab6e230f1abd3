#include "common/process/memory.hpp"

#include <malloc.h>

namespace aisle::process {

void keep_no_large_blocks() {
  // Said once, glibc no longer raises the limit to the largest block that was ever freed, which would keep a map's worth of heap.
  constexpr int kLargeBytes = 64 * 1024;
  mallopt(M_MMAP_THRESHOLD, kLargeBytes);
}

void give_back_free_memory() { malloc_trim(0); }

}  // namespace aisle::process
