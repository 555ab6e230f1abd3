#include "services/map/core/journal.hpp"

#include <sqlite3.h>

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <cstring>
#include <iterator>
#include <utility>

#include "common/config/reader.hpp"

namespace aisle::map {
namespace {

using fleet::MapEdit;

constexpr int kSchema = 1;  // of the tables below; a file with another number is not read
constexpr int kBusyMs = 1000;

/// What SQLite says of its last call, with its result code.
class SqlError : public std::runtime_error {
 public:
  explicit SqlError(sqlite3* database)
      : std::runtime_error(sqlite3_errmsg(database)), code(sqlite3_errcode(database)) {}

  int code;
};

/// One prepared statement; values are bound in order, from 1, and read by column, from 0.
class Statement {
 public:
  Statement(sqlite3* database, const char* sql) : database_(database) {
    if (sqlite3_prepare_v2(database, sql, -1, &statement_, nullptr) != SQLITE_OK) throw SqlError(database);
  }

  ~Statement() { sqlite3_finalize(statement_); }

  Statement(const Statement&) = delete;
  Statement& operator=(const Statement&) = delete;

  /// Binds the next value: a number, a text, or doubles as a blob. @throws SqlError
  Statement& bind(std::int64_t value) { return check(sqlite3_bind_int64(statement_, ++bound_, value)); }
  Statement& bind(double value) { return check(sqlite3_bind_double(statement_, ++bound_, value)); }
  Statement& bind(const std::string& value) {
    return check(
        sqlite3_bind_text(statement_, ++bound_, value.data(), static_cast<int>(value.size()), SQLITE_TRANSIENT));
  }

  Statement& bind(const std::vector<double>& values) {
    if (values.empty()) return check(sqlite3_bind_zeroblob(statement_, ++bound_, 0));  // its data() would be NULL

    return check(sqlite3_bind_blob(statement_, ++bound_, values.data(),
                                   static_cast<int>(values.size() * sizeof(double)), SQLITE_TRANSIENT));
  }

  /// False when there is no further row.
  bool step() {
    const int code = sqlite3_step(statement_);
    if (code != SQLITE_ROW && code != SQLITE_DONE) throw SqlError(database_);
    return code == SQLITE_ROW;
  }

  /// Values of the present row. @pre step() was true
  std::int64_t integer(int column) const { return sqlite3_column_int64(statement_, column); }
  double real(int column) const { return sqlite3_column_double(statement_, column); }

  std::string text(int column) const {
    const auto* bytes = static_cast<const char*>(sqlite3_column_blob(statement_, column));
    return bytes == nullptr ? std::string()
                            : std::string(bytes, static_cast<std::size_t>(sqlite3_column_bytes(statement_, column)));
  }

  /// The doubles of a blob, as bind() wrote them.
  std::vector<double> reals(int column) const {
    const std::string bytes = text(column);
    std::vector<double> values(bytes.size() / sizeof(double));
    if (!values.empty()) std::memcpy(values.data(), bytes.data(), values.size() * sizeof(double));

    return values;
  }

 private:
  /// @throws SqlError unless `code` says success
  Statement& check(int code) {
    if (code != SQLITE_OK) throw SqlError(database_);
    return *this;
  }

  sqlite3* database_;
  sqlite3_stmt* statement_{nullptr};
  int bound_{0};
};

/// Runs one statement without values and ignores its rows.
void execute(sqlite3* database, const std::string& sql) {
  Statement statement(database, sql.c_str());
  while (statement.step()) {
  }
}

/// 16 digits: SQLite's integers are signed, hashes are not.
std::string hexadecimal(std::uint64_t value) {
  char text[20];
  std::snprintf(text, sizeof(text), "%016llx", static_cast<unsigned long long>(value));
  return text;
}

/// A value of the table `about`; empty when it is not there.
std::string stored(sqlite3* database, const std::string& name) {
  Statement statement(database, "SELECT value FROM about WHERE name = ?");
  statement.bind(name);
  return statement.step() ? statement.text(0) : std::string();
}

/// x, y, x, y, ... as a blob holds them.
std::vector<double> flat(const std::vector<geometry::Point2>& points) {
  std::vector<double> numbers;
  for (const geometry::Point2 point : points) {
    numbers.push_back(point.x);
    numbers.push_back(point.y);
  }

  return numbers;
}

/// The points of such a blob.
std::vector<geometry::Point2> points_of(const std::vector<double>& numbers) {
  std::vector<geometry::Point2> points;
  for (std::size_t i = 0; i + 1 < numbers.size(); i += 2) points.push_back({numbers[i], numbers[i + 1]});

  return points;
}

/// What is said of an entry that cannot be used.
config::BadInput broken(const std::filesystem::path& file, std::uint64_t revision, const std::string& why) {
  return config::BadInput("journal " + file.string() + ": entry of revision " + std::to_string(revision) + " " + why +
                          ": restore the file from a copy, or move it away to drop its edits");
}

/// Adds a value to the table `about`. @throws SqlError
void store(sqlite3* database, const std::string& name, const std::string& value) {
  Statement(database, "INSERT INTO about(name, value) VALUES(?, ?)").bind(name).bind(value).step();
}

}  // namespace

void Journal::Close::operator()(sqlite3* handle) const { sqlite3_close(handle); }

Journal::Journal(const std::filesystem::path& file, const std::string& map_id, std::uint64_t base_hash,
                 const Options& options)
    : file_(file) {
  try {
    open(options);
    bind_to_map(map_id, base_hash, options.zones_hash);
  } catch (const SqlError& error) {
    const std::string name = "journal " + file_.string();
    if (error.code == SQLITE_NOTADB || error.code == SQLITE_CORRUPT) {
      throw config::BadInput(name + ": is not a journal of aisle-map (" + error.what() +
                             "): name another file, or move this one away");
    }

    if (error.code == SQLITE_BUSY)
      throw config::BadEnvironment(name + ": another process has it open: stop that, or name another file");
    throw config::BadEnvironment(name + ": cannot be used: " + error.what() + ": check folder, permissions and space");
  }
}

Journal::~Journal() = default;

void Journal::open(const Options& options) {
  sqlite3* handle = nullptr;
  const int code = sqlite3_open_v2(file_.c_str(), &handle, SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE, nullptr);
  database_.reset(handle);

  if (code != SQLITE_OK) throw SqlError(handle);
  sqlite3_busy_timeout(handle, kBusyMs);

  // Exclusive: one process at a time. Write-ahead log with full synchronisation: what is committed is on the disk.
  execute(handle, "PRAGMA locking_mode = EXCLUSIVE");
  execute(handle, "PRAGMA journal_mode = WAL");
  execute(handle, "PRAGMA synchronous = FULL");

  // SQLite limits a file by pages; at least 16, so that the tables themselves fit.
  Statement page_size(handle, "PRAGMA page_size");
  page_size.step();
  execute(handle, "PRAGMA max_page_count = " +
                      std::to_string(std::max<std::int64_t>(16, options.max_bytes / page_size.integer(0))));
}

void Journal::bind_to_map(const std::string& map_id, std::uint64_t base_hash, std::uint64_t zones_hash) {
  sqlite3* database = database_.get();
  execute(database, "BEGIN IMMEDIATE");
  execute(database, "CREATE TABLE IF NOT EXISTS about(name TEXT PRIMARY KEY, value TEXT NOT NULL) WITHOUT ROWID");
  execute(database,
          "CREATE TABLE IF NOT EXISTS edits(revision INTEGER PRIMARY KEY, edit_id TEXT NOT NULL UNIQUE, action INTEGER "
          "NOT NULL, "
          "shape INTEGER NOT NULL, points BLOB NOT NULL, radius_m REAL NOT NULL, changed_cells INTEGER NOT NULL, "
          "source_id TEXT NOT NULL, stamp_ns INTEGER NOT NULL)");
  execute(database,
          "CREATE TABLE IF NOT EXISTS zone_edits(revision INTEGER PRIMARY KEY, edit_id TEXT NOT NULL UNIQUE, action "
          "INTEGER NOT NULL, zone_id TEXT NOT NULL, kind INTEGER NOT NULL, shape INTEGER NOT NULL, points BLOB NOT "
          "NULL, radius_m REAL NOT NULL, max_speed_mps REAL NOT NULL, direction_rad REAL NOT NULL, source_id TEXT NOT "
          "NULL, stamp_ns INTEGER NOT NULL)");

  // A new file takes the identity of this map; an old one must have it.
  const std::string schema = stored(database, "schema");
  if (schema.empty()) {
    store(database, "schema", std::to_string(kSchema));
    store(database, "map_id", map_id);
    store(database, "base_hash", hexadecimal(base_hash));
    store(database, "zones_hash", hexadecimal(zones_hash));
  }

  const std::string remedy = ": name another journal, or move this one away to drop its edits";
  const std::string name = "journal " + file_.string();
  if (!schema.empty() && schema != std::to_string(kSchema)) {
    throw config::BadInput(name + ": schema " + schema + " is not " + std::to_string(kSchema) + remedy);
  }

  if (stored(database, "map_id") != map_id) {
    throw config::BadInput(name + ": belongs to map '" + stored(database, "map_id") + "', not to '" + map_id + "'" +
                           remedy);
  }

  if (stored(database, "base_hash") != hexadecimal(base_hash)) {
    throw config::BadInput(name + ": was written over another content of the map file (hash " +
                           stored(database, "base_hash") + ", now " + hexadecimal(base_hash) + ")" + remedy);
  }

  // Journals from before there were zones do not name their hash: there were none.
  const std::string zones = stored(database, "zones_hash");
  if ((zones.empty() ? hexadecimal(0) : zones) != hexadecimal(zones_hash)) {
    throw config::BadInput(name + ": was written over other zones of the map's file of zones" + remedy);
  }

  execute(database, "COMMIT");
}

std::vector<JournalEntry> Journal::entries() const {
  std::vector<JournalEntry> of_cells = cell_edits();
  std::vector<JournalEntry> of_zones = zone_edits();

  // Both tables are in order; together they have each revision once.
  std::vector<JournalEntry> entries;
  std::merge(std::make_move_iterator(of_cells.begin()), std::make_move_iterator(of_cells.end()),
             std::make_move_iterator(of_zones.begin()), std::make_move_iterator(of_zones.end()),
             std::back_inserter(entries),
             [](const JournalEntry& a, const JournalEntry& b) { return a.revision < b.revision; });

  for (std::size_t i = 1; i < entries.size(); ++i) {
    if (entries[i].revision != entries[i - 1].revision + 1)
      throw broken(file_, entries[i].revision, "does not follow on the one before");
  }

  return entries;
}

std::vector<JournalEntry> Journal::cell_edits() const {
  std::vector<JournalEntry> entries;
  const std::string map_id = stored(database_.get(), "map_id");
  Statement statement(database_.get(),
                      "SELECT revision, edit_id, action, shape, points, radius_m, changed_cells, source_id, stamp_ns "
                      "FROM edits ORDER BY revision");
  while (statement.step()) {
    JournalEntry entry;
    entry.revision = static_cast<std::uint64_t>(statement.integer(0));
    entry.edit.edit_id = statement.text(1);
    entry.edit.map_id = map_id;

    // Numbers of enumerations come from a file: check them before they become enumerators.
    const std::int64_t action = statement.integer(2);
    const std::int64_t shape = statement.integer(3);
    if (action < 0 || action > 1 || shape < 0 || shape > 2)
      throw broken(file_, entry.revision, "has an unknown action or shape");

    entry.edit.action = static_cast<MapEdit::Action>(action);
    entry.edit.shape = static_cast<MapEdit::Shape>(shape);

    entry.edit.points_in_map = points_of(statement.reals(4));
    entry.edit.radius_m = statement.real(5);
    entry.changed_cells = static_cast<std::uint32_t>(statement.integer(6));
    entry.source_id = statement.text(7);
    entry.stamp_ns = statement.integer(8);

    entries.push_back(std::move(entry));
  }

  return entries;
}

std::vector<JournalEntry> Journal::zone_edits() const {
  std::vector<JournalEntry> entries;
  const std::string map_id = stored(database_.get(), "map_id");
  Statement statement(database_.get(),
                      "SELECT revision, edit_id, action, zone_id, kind, shape, points, radius_m, max_speed_mps, "
                      "direction_rad, source_id, stamp_ns FROM zone_edits ORDER BY revision");
  while (statement.step()) {
    JournalEntry entry;
    entry.revision = static_cast<std::uint64_t>(statement.integer(0));

    fleet::ZoneEdit edit;
    edit.edit_id = statement.text(1);
    edit.map_id = map_id;

    // As for cells: numbers become enumerators only once they are known.
    const std::int64_t action = statement.integer(2);
    const std::int64_t kind = statement.integer(4);
    const std::int64_t shape = statement.integer(5);
    if (action < 0 || action > 1 || kind < 0 || kind > 5 || shape < 0 || shape > 2)
      throw broken(file_, entry.revision, "has an unknown action, kind or shape");

    edit.action = static_cast<fleet::ZoneEdit::Action>(action);
    edit.zone.id = statement.text(3);
    edit.zone.kind = static_cast<fleet::Zone::Kind>(kind);
    edit.zone.shape = static_cast<fleet::Zone::Shape>(shape);
    edit.zone.points_in_map = points_of(statement.reals(6));
    edit.zone.radius_m = statement.real(7);
    edit.zone.max_speed_mps = statement.real(8);
    edit.zone.direction_rad = statement.real(9);

    entry.source_id = statement.text(10);
    entry.stamp_ns = statement.integer(11);
    entry.zone_edit = std::move(edit);

    entries.push_back(std::move(entry));
  }

  return entries;
}

namespace {

void insert_cell_edit(sqlite3* database, const JournalEntry& entry) {
  Statement(database, "INSERT INTO edits VALUES(?, ?, ?, ?, ?, ?, ?, ?, ?)")
      .bind(static_cast<std::int64_t>(entry.revision))
      .bind(entry.edit.edit_id)
      .bind(static_cast<std::int64_t>(entry.edit.action))
      .bind(static_cast<std::int64_t>(entry.edit.shape))
      .bind(flat(entry.edit.points_in_map))
      .bind(entry.edit.radius_m)
      .bind(static_cast<std::int64_t>(entry.changed_cells))
      .bind(entry.source_id)
      .bind(entry.stamp_ns)
      .step();
}

void insert_zone_edit(sqlite3* database, const JournalEntry& entry) {
  const fleet::Zone& zone = entry.zone_edit->zone;
  Statement(database, "INSERT INTO zone_edits VALUES(?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)")
      .bind(static_cast<std::int64_t>(entry.revision))
      .bind(entry.zone_edit->edit_id)
      .bind(static_cast<std::int64_t>(entry.zone_edit->action))
      .bind(zone.id)
      .bind(static_cast<std::int64_t>(zone.kind))
      .bind(static_cast<std::int64_t>(zone.shape))
      .bind(flat(zone.points_in_map))
      .bind(zone.radius_m)
      .bind(zone.max_speed_mps)
      .bind(zone.direction_rad)
      .bind(entry.source_id)
      .bind(entry.stamp_ns)
      .step();
}

}  // namespace

void Journal::append(const JournalEntry& entry) {
  // One statement is one transaction: the entry is kept whole or not at all.
  try {
    if (entry.zone_edit) {
      insert_zone_edit(database_.get(), entry);
    } else {
      insert_cell_edit(database_.get(), entry);
    }
  } catch (const SqlError& error) {
    throw JournalError("journal " + file_.string() + " cannot keep it: " + error.what());
  }
}

}  // namespace aisle::map
