#pragma once

#include <cstdio>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "tools/lab/results/result_text.hpp"

namespace aisle::lab {

/// Holds a file's advisory lock while it lives.
class FileLock {
 public:
  /// @throws config::BadEnvironment when another process, or another lock, has it
  explicit FileLock(const std::filesystem::path& file);
  ~FileLock();
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;

 private:
  int descriptor_;
};

/// A folder with the results of a sweep: `results.jsonl` and `results.csv`, one row a trial, appended and flushed trial
/// by trial. A sweep that was ended at any moment goes on where it was: rows that are whole are kept, a last line that
/// was cut off is dropped, and results.csv is written anew from results.jsonl. One process at a time.
class SweepFolder {
 public:
  /// Makes the folder, or opens what is there. `head` names the sweep (key "sweep") and the commit.
  /// @throws config::BadInput when the folder holds another sweep, or one of another commit, a damaged file, or
  /// results that are not of a sweep;
  /// config::BadEnvironment when it cannot be written, or another process writes there
  SweepFolder(const std::filesystem::path& folder, const Row& head, const std::vector<std::string>& columns);
  ~SweepFolder();
  SweepFolder(const SweepFolder&) = delete;
  SweepFolder& operator=(const SweepFolder&) = delete;

  /// The rows that were there, by their key "trial".
  const std::map<std::size_t, Row>& kept() const { return kept_; }

  /// @throws config::BadEnvironment when the disk is full
  void append(const Row& row);

 private:
  /// @returns the bytes of the whole lines; 0 where no sweep was begun
  std::size_t read_kept(const Row& head);

  std::filesystem::path folder_;
  FileLock lock_;
  std::vector<std::string> columns_;
  std::map<std::size_t, Row> kept_;
  std::FILE* jsonl_{nullptr};
  std::FILE* csv_{nullptr};
};

}  // namespace aisle::lab
