#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "common/process/file_store.hpp"

namespace aisle::sim {

/// The disk of one simulated process. What was synced survives a crash; everything else is gone with
/// it. A kept file is synced as a whole or not written at all; SQLite writes parts of a file and syncs
/// them later (sqlite_on_disk.hpp).
class Disk final : public process::FileStore {
 public:
  /// A file's content, and the part of its history that counts after a crash.
  struct File {
    std::string bytes;   // as readers see it now
    std::string synced;  // as a crash leaves it
  };

  bool write(const std::filesystem::path& file, const std::string& text) override;
  std::optional<std::string> read(const std::filesystem::path& file, std::uintmax_t most_bytes) const override;

  /// Is there a file of this name?
  bool exists(const std::string& name) const { return files_.count(name) > 0; }

  /// Made empty where it is missing. Holds until the file is removed.
  File& open(const std::string& name) { return files_[name]; }

  /// As if the file had never been there.
  void remove(const std::string& name) { files_.erase(name); }

  /// All files as a crash leaves them. To be taken before the process ends: what its destructors still
  /// write comes too late.
  std::map<std::string, File> as_synced() const;
  void restore(std::map<std::string, File> files) { files_ = std::move(files); }

  /// While the disk is full, nothing is written: no kept file is replaced, and SQLite may not overwrite
  /// existing bytes either. Files may still be cut shorter and removed.
  void set_full(bool full) { is_full_ = full; }
  bool is_full() const { return is_full_; }

  /// Cuts each file off in its middle, as a host that lost its power may leave it. @pre no process has them open
  void tear_files();

  /// Has it no files at all?
  bool is_empty() const { return files_.empty(); }

  /// @pre no process has them open
  void lose_files() { files_.clear(); }

 private:
  std::map<std::string, File> files_;
  bool is_full_{false};
};

/// The disk of the process that runs now on this thread: kept files and SQLite's files go there while it lives.
class ScopedDisk {
 public:
  /// @pre `disk` outlives it
  explicit ScopedDisk(Disk& disk);
  ~ScopedDisk();
  ScopedDisk(const ScopedDisk&) = delete;
  ScopedDisk& operator=(const ScopedDisk&) = delete;

  /// Null outside any scope.
  static Disk* current();

 private:
  Disk* before_;
  process::ScopedFileStore kept_files_;
};

}  // namespace aisle::sim
