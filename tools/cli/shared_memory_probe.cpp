#include "tools/cli/shared_memory_probe.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <fstream>
#include <set>
#include <string>
#include <system_error>

namespace aisle::cli {
namespace {

namespace fs = std::filesystem;

/// By the prefixes that both releases give their segments.
bool is_of_fast_dds(const std::string& name) {
  return name.rfind("fastrtps_", 0) == 0 || name.rfind("fastdds_", 0) == 0 || name.rfind("sem.fastrtps_", 0) == 0 ||
         name.rfind("sem.fastdds_", 0) == 0;
}

/// Files in `folder` that live processes have mapped, as far as we may look into them.
std::set<std::string> find_mapped(const fs::path& folder) {
  std::set<std::string> mapped;
  std::error_code ignored;

  for (const fs::directory_entry& process : fs::directory_iterator("/proc", ignored)) {
    const std::string id = process.path().filename();
    if (!std::all_of(id.begin(), id.end(), [](unsigned char c) { return std::isdigit(c) != 0; })) continue;

    std::ifstream maps(process.path() / "maps");
    for (std::string line; std::getline(maps, line);) {
      const std::size_t begin = line.find('/');
      if (begin != std::string::npos && line.compare(begin, folder.string().size(), folder.string()) == 0)
        mapped.insert(line.substr(begin));
    }
  }

  return mapped;
}

/// Segments of other users may be in use by processes that we may not look into.
bool is_ours(const fs::path& file) {
  struct stat status {};
  return stat(file.c_str(), &status) == 0 && (geteuid() == 0 || status.st_uid == geteuid());
}

}  // namespace

/// A segment is left over when no live process that we may look into has mapped it.
SharedMemory probe_shared_memory(const fs::path& folder) {
  SharedMemory memory;
  memory.folder = folder.string();

  std::error_code error;
  const fs::space_info space = fs::space(folder, error);
  if (error || !fs::is_directory(folder, error)) return memory;

  memory.exists = true;
  memory.is_writable = access(folder.c_str(), R_OK | W_OK | X_OK) == 0;
  memory.capacity_bytes = space.capacity;
  memory.available_bytes = space.available;

  // Segments that no process has mapped.
  const std::set<std::string> mapped = find_mapped(folder);
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    const std::string name = entry.path().filename();

    // Lock files (…_el, …_sl) and semaphores are not mapped by the processes that hold them; they go with their
    // segment.
    const bool is_segment =
        name.rfind("sem.", 0) != 0 && name.find("_el") == std::string::npos && name.find("_sl") == std::string::npos;
    if (!is_of_fast_dds(name) || !is_segment || mapped.count(entry.path().string()) > 0 || !is_ours(entry.path()))
      continue;

    std::error_code gone;
    const std::uintmax_t bytes = entry.file_size(gone);
    if (gone) continue;

    ++memory.left_over_files;
    memory.left_over_bytes += bytes;
  }

  return memory;
}

}  // namespace aisle::cli
