// What a simulated disk keeps over a crash, and SQLite on it.
#include "tools/sim/disk.hpp"

#include <gtest/gtest.h>

#include <string>

#include "common/config/reader.hpp"
#include "common/process/kept_file.hpp"
#include "services/map/core/journal.hpp"
#include "tools/sim/sqlite_on_disk.hpp"

namespace aisle::sim {
namespace {

constexpr std::uint64_t kMapHash = 42;

map::JournalEntry entry_of(std::uint64_t revision) {
  map::JournalEntry entry;
  entry.revision = revision;
  entry.edit.edit_id = "edit-" + std::to_string(revision);
  entry.edit.points_in_map = {{1.0, 2.0}, {3.0, 4.0}};
  return entry;
}

TEST(Disk, KeptFilesLieOnTheDiskOfTheProcessThatRuns) {
  Disk one, other;
  {
    const ScopedDisk scope(one);
    EXPECT_TRUE(process::keep_in_file("state", "mine"));
    EXPECT_EQ(process::read_kept_file("state"), "mine");
  }
  const ScopedDisk scope(other);
  EXPECT_EQ(process::read_kept_file("state"), std::nullopt);
}

TEST(Disk, AFullOneKeepsTheOldText) {
  Disk disk;
  const ScopedDisk scope(disk);
  EXPECT_TRUE(process::keep_in_file("state", "old"));
  disk.set_full(true);
  EXPECT_FALSE(process::keep_in_file("state", "new"));
  EXPECT_EQ(process::read_kept_file("state"), "old");
  disk.set_full(false);
  EXPECT_TRUE(process::keep_in_file("state", "new"));
}

TEST(Disk, TornFilesAreHalfThereAndLostOnesNot) {
  Disk disk;
  const ScopedDisk scope(disk);
  EXPECT_TRUE(process::keep_in_file("state", "12345678"));
  disk.tear_files();
  EXPECT_EQ(process::read_kept_file("state"), "1234");
  disk.lose_files();
  EXPECT_EQ(process::read_kept_file("state"), std::nullopt);
}

class SqliteOnDisk : public ::testing::Test {
 protected:
  SqliteOnDisk() { put_sqlite_on_simulated_disks(); }
  static map::Journal open() { return {"map.sqlite", "hall", kMapHash, map::Journal::Options{}}; }
  Disk disk_;
  ScopedDisk scope_{disk_};
};

TEST_F(SqliteOnDisk, WhatWasCommittedSurvivesACrash) {
  std::map<std::string, Disk::File> left;
  {
    map::Journal journal = open();
    journal.append(entry_of(2));
    journal.append(entry_of(3));
    left = disk_.as_synced();
  }
  disk_.restore(left);
  EXPECT_EQ(open().entries().size(), 2u);
}

TEST_F(SqliteOnDisk, AFullDiskRefusesAnEntryAndTakesItLater) {
  map::Journal journal = open();
  journal.append(entry_of(2));
  disk_.set_full(true);
  EXPECT_THROW(journal.append(entry_of(3)), map::JournalError);
  disk_.set_full(false);
  journal.append(entry_of(3));
  EXPECT_EQ(journal.entries().size(), 2u);
}

TEST_F(SqliteOnDisk, ATornFileIsNoticed) {
  {
    map::Journal journal = open();
    journal.append(entry_of(2));
  }
  disk_.tear_files();
  EXPECT_ANY_THROW(open().entries());
}

TEST_F(SqliteOnDisk, EachProcessHasItsOwnDatabase) {
  Disk other;
  {
    const ScopedDisk inner(other);
    EXPECT_EQ(ScopedDisk::current(), &other);
    map::Journal journal = open();
    EXPECT_TRUE(other.exists("map.sqlite"));
  }
  EXPECT_FALSE(disk_.exists("map.sqlite"));
}

}  // namespace
}  // namespace aisle::sim
