// SQLite's "virtual file system" (sqlite.org/vfs.html): the few functions through which it reaches files, the clock and
// chance. A database in WAL mode with an exclusive lock needs no shared memory, so version 1 of the file methods does.

#include "tools/sim/sqlite_on_disk.hpp"

#include <sqlite3.h>

#include <algorithm>
#include <cstring>
#include <new>
#include <string>

#include "tools/sim/disk.hpp"

namespace aisle::sim {
namespace {

constexpr double kJulianDayOf1970 = 2440587.5;

/// SQLite's handle of a file of ours, see https://www.sqlite.org/vfs.html.
struct OpenFile {
  sqlite3_file base;  // first: SQLite sees only this
  Disk* disk;
  Disk::File* file;
  const char* name;
  bool delete_on_close;
};

/// The handle behind SQLite's view of it.
OpenFile& of(sqlite3_file* file) { return *reinterpret_cast<OpenFile*>(file); }

int close_file(sqlite3_file* file) {
  const OpenFile& open = of(file);
  if (open.delete_on_close) open.disk->remove(open.name);
  return SQLITE_OK;
}

/// Beyond the end the buffer is filled with zeros, as SQLite asks.
int read_file(sqlite3_file* file, void* to, int count, sqlite3_int64 offset) {
  const std::string& bytes = of(file).file->bytes;
  const auto begin = std::min(static_cast<std::size_t>(offset), bytes.size());
  const auto there = std::min(static_cast<std::size_t>(count), bytes.size() - begin);

  std::memcpy(to, bytes.data() + begin, there);
  if (there == static_cast<std::size_t>(count)) return SQLITE_OK;

  std::memset(static_cast<char*>(to) + there, 0, static_cast<std::size_t>(count) - there);
  return SQLITE_IOERR_SHORT_READ;
}

/// Grows the file where it is too short.
int write_file(sqlite3_file* file, const void* from, int count, sqlite3_int64 offset) {
  const OpenFile& open = of(file);
  std::string& bytes = open.file->bytes;
  const auto end = static_cast<std::size_t>(offset) + static_cast<std::size_t>(count);

  if (open.disk->is_full()) return SQLITE_FULL;

  if (bytes.size() < end) bytes.resize(end);
  std::memcpy(bytes.data() + offset, from, static_cast<std::size_t>(count));

  return SQLITE_OK;
}

int truncate_file(sqlite3_file* file, sqlite3_int64 size) {
  of(file).file->bytes.resize(static_cast<std::size_t>(size));
  return SQLITE_OK;
}

/// From here on a crash leaves this content.
int sync_file(sqlite3_file* file, int) {
  of(file).file->synced = of(file).file->bytes;
  return SQLITE_OK;
}

int size_of_file(sqlite3_file* file, sqlite3_int64* size) {
  *size = static_cast<sqlite3_int64>(of(file).file->bytes.size());
  return SQLITE_OK;
}

/// Every database belongs to one process: nothing has to be locked.
int lock_file(sqlite3_file*, int) { return SQLITE_OK; }

int is_locked(sqlite3_file*, int* answer) {
  *answer = 0;
  return SQLITE_OK;
}

int control_file(sqlite3_file*, int, void*) { return SQLITE_NOTFOUND; }
int sector_bytes(sqlite3_file*) { return 4096; }
int device_traits(sqlite3_file*) { return 0; }

const sqlite3_io_methods kMethods{
    1,         close_file, read_file, write_file,   truncate_file, sync_file,     size_of_file,
    lock_file, lock_file,  is_locked, control_file, sector_bytes,  device_traits, nullptr,
    nullptr,   nullptr,    nullptr,   nullptr,      nullptr};

sqlite3_vfs* host_vfs = nullptr;

/// On the disk of the process that runs now; without one, on the host's.
int open_file(sqlite3_vfs*, const char* name, sqlite3_file* file, int flags, int* out_flags) {
  Disk* disk = ScopedDisk::current();
  if (disk == nullptr) return host_vfs->xOpen(host_vfs, name, file, flags, out_flags);

  const char* known = name == nullptr ? "temporary" : name;
  if (!disk->exists(known) && (flags & SQLITE_OPEN_CREATE) == 0) return SQLITE_CANTOPEN;

  OpenFile* open = new (file) OpenFile{};
  open->base.pMethods = &kMethods;
  open->disk = disk;
  open->file = &disk->open(known);
  open->name = known;
  open->delete_on_close = (flags & SQLITE_OPEN_DELETEONCLOSE) != 0;
  if (out_flags != nullptr) *out_flags = flags;

  return SQLITE_OK;
}

int delete_file(sqlite3_vfs*, const char* name, int sync) {
  Disk* disk = ScopedDisk::current();
  if (disk == nullptr) return host_vfs->xDelete(host_vfs, name, sync);
  disk->remove(name);
  return SQLITE_OK;
}

int access_file(sqlite3_vfs*, const char* name, int flags, int* answer) {
  Disk* disk = ScopedDisk::current();
  if (disk == nullptr) return host_vfs->xAccess(host_vfs, name, flags, answer);
  *answer = disk->exists(name) ? 1 : 0;
  return SQLITE_OK;
}

int full_path(sqlite3_vfs*, const char* name, int size, char* to) {
  if (ScopedDisk::current() == nullptr) return host_vfs->xFullPathname(host_vfs, name, size, to);
  if (std::strlen(name) >= static_cast<std::size_t>(size)) return SQLITE_CANTOPEN;
  std::strcpy(to, name);
  return SQLITE_OK;
}

/// Simulated databases get numbers that are always the same.
int random_bytes(sqlite3_vfs*, int count, char* to) {
  if (ScopedDisk::current() == nullptr) return host_vfs->xRandomness(host_vfs, count, to);
  for (int i = 0; i < count; ++i) to[i] = static_cast<char>(37 * i + 11);
  return count;
}

/// Virtual time does not pass here.
int sleep_us(sqlite3_vfs*, int us) { return ScopedDisk::current() == nullptr ? host_vfs->xSleep(host_vfs, us) : us; }

int julian_day(sqlite3_vfs*, double* day) {
  if (ScopedDisk::current() == nullptr) return host_vfs->xCurrentTime(host_vfs, day);
  *day = kJulianDayOf1970;
  return SQLITE_OK;
}

int last_error(sqlite3_vfs*, int, char*) { return 0; }

}  // namespace

void put_sqlite_on_simulated_disks() {
  static sqlite3_vfs ours = [] {
    sqlite3_initialize();
    host_vfs = sqlite3_vfs_find(nullptr);

    sqlite3_vfs vfs{};
    vfs.iVersion = 1;
    vfs.szOsFile = std::max(host_vfs->szOsFile, static_cast<int>(sizeof(OpenFile)));
    vfs.mxPathname = host_vfs->mxPathname;
    vfs.zName = "aisle-simulated";
    vfs.xOpen = open_file;
    vfs.xDelete = delete_file;
    vfs.xAccess = access_file;
    vfs.xFullPathname = full_path;
    vfs.xRandomness = random_bytes;
    vfs.xSleep = sleep_us;
    vfs.xCurrentTime = julian_day;
    vfs.xGetLastError = last_error;

    return vfs;
  }();

  static const int registered = sqlite3_vfs_register(&ours, 1);
  static_cast<void>(registered);
}

}  // namespace aisle::sim
