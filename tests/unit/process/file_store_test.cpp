// Files that services keep: on the disk, and in a store that takes its place.
#include "common/process/file_store.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <map>
#include <string>

#include "common/process/kept_file.hpp"

namespace aisle::process {
namespace {

class Memory final : public FileStore {
 public:
  bool write(const std::filesystem::path& file, const std::string& text) override {
    texts[file.string()] = text;
    return !is_full;
  }
  std::optional<std::string> read(const std::filesystem::path& file, std::uintmax_t most_bytes) const override {
    const auto found = texts.find(file.string());
    if (found == texts.end() || found->second.size() > most_bytes) return std::nullopt;
    return found->second;
  }
  std::map<std::string, std::string> texts;
  bool is_full{false};
};

std::filesystem::path fresh_folder() {
  const auto folder = std::filesystem::temp_directory_path() / ("aisle-file-store-" + std::to_string(getpid()));
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  return folder;
}

TEST(FileStore, TheDiskKeepsTheNewestTextAndNothingBesideIt) {
  const std::filesystem::path folder = fresh_folder();
  EXPECT_TRUE(keep_in_file(folder / "state", "one"));
  EXPECT_TRUE(keep_in_file(folder / "state", "two"));
  EXPECT_EQ(read_kept_file(folder / "state"), "two");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder), {}), 1);
  EXPECT_FALSE(keep_in_file(folder / "no-such-folder" / "state", "three"));
  EXPECT_EQ(read_kept_file(folder / "missing"), std::nullopt);
  std::filesystem::remove_all(folder);
}

TEST(FileStore, AFileBeyondTheBoundIsNotRead) {
  const std::filesystem::path folder = fresh_folder();
  EXPECT_TRUE(keep_in_file(folder / "state", std::string(65536, 'x')));
  EXPECT_TRUE(read_kept_file(folder / "state").has_value());
  EXPECT_TRUE(keep_in_file(folder / "state", std::string(65537, 'x')));
  EXPECT_EQ(read_kept_file(folder / "state"), std::nullopt);
  std::filesystem::remove_all(folder);
}

TEST(FileStore, AnotherStoreTakesTheDisksPlaceWhileItsScopeLives) {
  Memory outer, inner;
  {
    const ScopedFileStore with_outer(outer);
    EXPECT_TRUE(keep_in_file("state", "outer"));
    {
      const ScopedFileStore with_inner(inner);
      EXPECT_EQ(read_kept_file("state"), std::nullopt);
      inner.is_full = true;
      EXPECT_FALSE(keep_in_file("state", "inner"));
    }
    EXPECT_EQ(read_kept_file("state"), "outer");
  }
  EXPECT_EQ(read_kept_file("state"), std::nullopt) << "the disk again";
}

}  // namespace
}  // namespace aisle::process
