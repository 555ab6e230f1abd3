#include "common/process/memory.hpp"

#include <link.h>
#include <malloc.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <fstream>
#include <string>

namespace aisle::process {
namespace {

/// The code and constants of one loaded file: pages that nobody wrote, and that the next use reads again from the page
/// cache. What the loader relocated is in writable segments, and stays.
int unmap_read_only_segments(dl_phdr_info* file, std::size_t, void*) {
  const std::uintptr_t page = static_cast<std::uintptr_t>(sysconf(_SC_PAGESIZE));
  for (int i = 0; i < file->dlpi_phnum; ++i) {
    const ElfW(Phdr)& segment = file->dlpi_phdr[i];
    if (segment.p_type != PT_LOAD || (segment.p_flags & PF_W) != 0) continue;

    const std::uintptr_t begin = (file->dlpi_addr + segment.p_vaddr + page - 1) / page * page;
    const std::uintptr_t end = (file->dlpi_addr + segment.p_vaddr + segment.p_memsz) / page * page;

    if (end > begin) madvise(reinterpret_cast<void*>(begin), end - begin, MADV_DONTNEED);
  }

  return 0;
}

/// A debugger's breakpoints stand in the code, and would be lost with it.
bool is_debugged() {
  std::ifstream status("/proc/self/status");
  std::string line;

  while (std::getline(status, line)) {
    if (line.rfind("TracerPid:", 0) == 0) return line.find_first_of("123456789") != std::string::npos;
  }

  return false;
}

}  // namespace

void keep_no_large_blocks() {
  // Said once, glibc no longer raises the limit to the largest block that was ever freed, which would keep a map's
  // worth of heap.
  constexpr int kLargeBytes = 64 * 1024;
  mallopt(M_MMAP_THRESHOLD, kLargeBytes);
}

void give_back_free_memory() { malloc_trim(0); }

void give_back_unused_code() {
  if (!is_debugged()) dl_iterate_phdr(unmap_read_only_segments, nullptr);
}

}  // namespace aisle::process
