#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "common/fleet/map_edit.hpp"
#include "common/fleet/zone.hpp"

struct sqlite3;

namespace aisle::map {

/// The journal could not take an edit (disk full, read-only, broken); nothing of it was kept.
class JournalError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// One accepted edit, of cells or of a zone, and the revision that it made.
struct JournalEntry {
  std::uint64_t revision{0};
  fleet::MapEdit edit;  // of cells
  std::uint32_t changed_cells{0};
  std::string source_id;     // the client that asked for it
  std::int64_t stamp_ns{0};  // when it was accepted, since the Unix epoch; for people, nothing is computed from it
  std::optional<fleet::ZoneEdit> zone_edit;  // of a zone: then `edit` says nothing
};

/// The accepted edits of one map, in SQLite: an entry is on the disk when append() returns, or not at all (write-ahead
/// log, synchronous=FULL). Belongs to one map id and to one content of the map file, and to one process at a time.
class Journal {
 public:
  struct Options {
    std::int64_t max_bytes{256LL << 20};  // the file grows no further; then append() throws
    std::uint64_t zones_hash{0};          // of the zones beside the map file, see hash_of()
  };

  /// Opens the journal or makes it. `base_hash`: of the map file's cells, see grid::map_hash.
  /// @throws config::BadInput when the file is no journal, or one of another map, or of another content of the map file
  /// or of its zones; config::BadEnvironment when it cannot be opened or written, or another process has it open
  Journal(const std::filesystem::path& file, const std::string& map_id, std::uint64_t base_hash,
          const Options& options);
  ~Journal();
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;

  /// In order of revision. @throws config::BadInput when an entry does not make sense
  std::vector<JournalEntry> entries() const;

  /// Writes one entry to the disk before it returns. @pre its revision follows on the last one's
  /// @throws JournalError
  void append(const JournalEntry& entry);

  /// For messages.
  const std::filesystem::path& file() const { return file_; }

 private:
  /// Closes the database when its owner goes.
  struct Close {
    void operator()(sqlite3* handle) const;
  };

  /// Opens the file, takes it for this process alone and makes each commit durable.
  void open(const Options& options);

  /// Makes the tables in a new file; in an old one checks schema, map id and hashes. @throws config::BadInput
  void bind_to_map(const std::string& map_id, std::uint64_t base_hash, std::uint64_t zones_hash);

  /// The entries of each table, by revision. @throws config::BadInput
  std::vector<JournalEntry> cell_edits() const;
  std::vector<JournalEntry> zone_edits() const;

  std::filesystem::path file_;
  std::unique_ptr<sqlite3, Close> database_;
};

}  // namespace aisle::map
