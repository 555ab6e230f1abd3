#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace aisle::process {

/// Keeps the small files that services need again after a restart: on the disk of this host, or on a
/// simulated one that can fill up, tear files and lose them.
class FileStore {
 public:
  virtual ~FileStore() = default;

  /// Replaces the whole file: a reader sees the old text or the new one. False when the store cannot take it (disk
  /// full, no such folder); then the old text stays.
  virtual bool write(const std::filesystem::path& file, const std::string& text) = 0;

  /// The whole text; none when there is no such file, or it is larger than `most_bytes`.
  virtual std::optional<std::string> read(const std::filesystem::path& file, std::uintmax_t most_bytes) const = 0;
};

/// The store that keep_in_file() and read_kept_file() use on this thread: the disk, unless a ScopedFileStore lives.
FileStore& file_store();

/// Takes the place of the disk on this thread while it lives: for a simulator, while it runs one of its
/// processes. May be nested.
class ScopedFileStore {
 public:
  explicit ScopedFileStore(FileStore& store);
  ~ScopedFileStore();
  ScopedFileStore(const ScopedFileStore&) = delete;
  ScopedFileStore& operator=(const ScopedFileStore&) = delete;

 private:
  FileStore* before_;
};

}  // namespace aisle::process
