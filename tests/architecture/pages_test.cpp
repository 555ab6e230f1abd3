// The pages for contributors name paths that exist, every room of common/ says what it is for, and the changelog begins
// with the version that is built.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/places.hpp"

namespace aisle {
namespace {

namespace fs = std::filesystem;

std::string text_of(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

/// Paths from the top of the tree, in backticks, that begin with one of its folders. What is built is not there yet,
/// and a name with a placeholder is no path.
std::vector<std::string> named_paths(const std::string& page) {
  static const std::regex kPath(
      "`((\\.ci|bench|common|deploy|docs|idl|python|services|tests|tools)/[^` <>*$|]*)[^`]*`");
  std::vector<std::string> paths;
  for (std::sregex_iterator it(page.begin(), page.end(), kPath), end; it != end; ++it) paths.push_back((*it)[1]);
  return paths;
}

/// `common/x.*` in a page is written up to the star: a file that begins like that is enough.
bool exists(const std::string& path) {
  const fs::path full = test_support::source_folder() / path;
  if (fs::exists(full)) return true;
  if (!fs::is_directory(full.parent_path())) return false;
  for (const auto& entry : fs::directory_iterator(full.parent_path())) {
    const std::string name = entry.path().filename().string();
    if (path.back() == '.' && name.rfind(full.filename().string(), 0) == 0) return true;
  }
  return false;
}

class Page : public testing::TestWithParam<const char*> {};

TEST_P(Page, NamesPathsThatExist) {
  const auto paths = named_paths(text_of(test_support::source_folder() / GetParam()));
  EXPECT_FALSE(paths.empty());
  for (const std::string& path : paths) EXPECT_TRUE(exists(path)) << path;
}

INSTANTIATE_TEST_SUITE_P(All, Page, testing::Values("CONTRIBUTING.md", "README.md"));

TEST(Rooms, SayWhatTheyAreFor) {
  for (const auto& entry : fs::directory_iterator(test_support::source_folder() / "common")) {
    if (!entry.is_directory()) continue;
    EXPECT_TRUE(fs::exists(entry.path() / "README.md")) << entry.path().filename();
  }
}

TEST(Changelog, BeginsWithTheVersionOfTheBuild) {
  const std::string build = text_of(test_support::source_folder() / "CMakeLists.txt");
  std::smatch version;
  ASSERT_TRUE(std::regex_search(build, version, std::regex("project\\(aisle VERSION ([0-9.]+)")));

  const std::string changes = text_of(test_support::source_folder() / "CHANGELOG.md");
  std::smatch heading;
  ASSERT_TRUE(std::regex_search(changes, heading, std::regex("\n## ([0-9.]+)")));
  EXPECT_EQ(heading[1], version[1]);
}

}  // namespace
}  // namespace aisle
