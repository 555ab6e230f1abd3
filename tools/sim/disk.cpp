#include "tools/sim/disk.hpp"

#include <utility>

namespace aisle::sim {
namespace {

thread_local Disk* current_disk = nullptr;

}  // namespace

bool Disk::write(const std::filesystem::path& file, const std::string& text) {
  if (is_full_) return false;
  files_[file.string()] = {text, text};
  return true;
}

std::optional<std::string> Disk::read(const std::filesystem::path& file, std::uintmax_t most_bytes) const {
  const auto found = files_.find(file.string());
  if (found == files_.end() || found->second.bytes.size() > most_bytes) return std::nullopt;
  return found->second.bytes;
}

std::map<std::string, Disk::File> Disk::as_synced() const {
  std::map<std::string, File> files;
  for (const auto& [name, file] : files_) files[name] = {file.synced, file.synced};
  return files;
}

void Disk::tear_files() {
  for (auto& [name, file] : files_) {
    file.bytes.resize(file.bytes.size() / 2);
    file.synced = file.bytes;
  }
}

ScopedDisk::ScopedDisk(Disk& disk) : before_(std::exchange(current_disk, &disk)), kept_files_(disk) {}
ScopedDisk::~ScopedDisk() { current_disk = before_; }
Disk* ScopedDisk::current() { return current_disk; }

}  // namespace aisle::sim
