// docs/experiments.md in its short form: what is cheap to measure is measured again, and must be what the page says, to
// the last digit. Left out are times, and ratios of times, which alone depend on the machine; and what takes minutes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/places.hpp"
#include "tests/unit/lab/page/committed_page.hpp"
#include "tools/lab/driving/fusion_tables.hpp"
#include "tools/lab/driving/window_cases.hpp"
#include "tools/lab/page/templates.hpp"
#include "tools/lab/papers/papers_section.hpp"
#include "tools/lab/papers/reproduce.hpp"
#include "tools/lab/planning/paper_tables.hpp"
#include "tools/lab/planning/random_tables.hpp"

namespace aisle::lab {
namespace {

namespace fs = std::filesystem;

constexpr const char* kCheapScene = "wang-2";  // no mover, no box: 30 drives of each contestant

void silent(const std::string&) {}

std::string content_of(const fs::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

fs::path committed_pictures() { return test_support::source_folder() / "docs/experiments"; }

/// A folder of this process's own that is gone again at the end.
class Folder {
 public:
  explicit Folder(const std::string& name)
      : path_(fs::path(::testing::TempDir()) / ("aisle-" + name + "-" + std::to_string(::getpid()))) {
    fs::remove_all(path_);
    fs::create_directories(path_);
  }
  ~Folder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

void expect_committed(const fs::path& pictures) {
  for (const auto& entry : fs::directory_iterator(pictures)) {
    const std::string name = entry.path().filename().string();
    EXPECT_TRUE(content_of(entry.path()) == content_of(committed_pictures() / name)) << name << " is another picture";
  }
}

/// Lines of a table by their first two cells: of the papers' rows, table and row.
std::map<std::string, std::string> lines_of(const std::string& table) {
  std::map<std::string, std::string> lines;
  std::istringstream in(table);
  for (std::string line; std::getline(in, line);)
    if (line.rfind("| ", 0) == 0 && line.rfind("| ---", 0) != 0)
      lines[line.substr(0, line.find(" | ", line.find(" | ") + 1))] = line;
  return lines;
}

bool is_a_time(const PublishedRow& row) {
  const auto* plan = std::get_if<PlanEvidence>(&row.evidence);
  return plan != nullptr && plan->figure == PlanFigure::kTime;
}

bool is_cheap(const PublishedRow& row) {
  const auto* drive = std::get_if<DriveEvidence>(&row.evidence);
  return !is_a_time(row) && (drive == nullptr || drive->scene == std::string(kCheapScene));
}

TEST(CommittedFigures, OfThePapersRowsAreMadeAgain) {
  const Texts texts = texts_of(kPapersTemplate, committed_section("papers"));
  EXPECT_EQ(texts.at("maps"), "200");
  EXPECT_EQ(texts.at("drives"), "30") << "the page was made without drives";
  const auto seed = static_cast<unsigned>(std::stoul(texts.at("seed")));
  Reproduction orders;
  orders.maps = {std::stoi(texts.at("maps")), seed};
  orders.drives = {std::stoi(texts.at("drives")), seed};
  orders.is_wanted = is_cheap;

  const std::map<std::string, std::string> committed = lines_of(texts.at("rows"));
  EXPECT_EQ(committed.size(), published_rows().size() + 1) << "a row is missing, or stands twice";
  for (const auto& [name, line] : lines_of(papers_rows_table(reproduce(orders, silent)))) {
    const auto found = committed.find(name);
    ASSERT_NE(found, committed.end()) << name;
    EXPECT_EQ(found->second, line);
  }
}

/// Of lines_of(): those rows that others are compared with, which repeat the verdict of the paper's own row.
std::set<std::string> reference_names() {
  std::set<std::string> names;
  for (const PublishedRow& row : published_rows())
    if (row.is_reference)
      names.insert("| " + row.table + " | " + std::regex_replace(row.row, std::regex(R"(\*)"), R"(\*)"));
  return names;
}

TEST(CommittedFigures, OfThePapersVerdictsAreCounted) {
  const Texts texts = texts_of(kPapersTemplate, committed_section("papers"));
  const std::set<std::string> references = reference_names();
  std::map<std::string, int> counted;
  std::size_t left_out = 0;
  for (const auto& [name, line] : lines_of(texts.at("rows"))) {
    if (references.count(name) > 0) {
      ++left_out;
      continue;
    }
    for (const char* verdict : {"same direction", "other direction", "not comparable"})
      if (line.find(std::string(" | ") + verdict + " | ") != std::string::npos) ++counted[verdict];
  }

  EXPECT_EQ(left_out, references.size());
  EXPECT_EQ(std::to_string(counted["same direction"]), texts.at("same"));
  EXPECT_EQ(std::to_string(counted["other direction"]), texts.at("other"));
  EXPECT_EQ(std::to_string(counted["not comparable"]), texts.at("none"));
  EXPECT_EQ(std::to_string(published_rows().size() - references.size()), texts.at("all"));
}

TEST(CommittedFigures, OfThePapersMapsAreDrawnAgain) {
  const Folder pictures("papers");
  const std::string links = papers_pictures(pictures.path(), "experiments");
  EXPECT_EQ(links, texts_of(kPapersTemplate, committed_section("papers")).at("pictures"));
  expect_committed(pictures.path());
}

TEST(CommittedFigures, OfGlobalPlannersOnThePapersMapsAreMadeAgain) {
  const Texts texts = texts_of(kGlobalPlanningTemplate, committed_section("global planning"));
  const Folder pictures("global");
  EXPECT_EQ(paper_tables(test_support::source_folder() / "deploy/experiments", pictures.path(), "experiments", silent),
            texts.at("paper_tables"));
  expect_committed(pictures.path());
}

TEST(CommittedFigures, OfGlobalPlannersOnBlockMapsAreMadeAgain) {
  const Texts texts = texts_of(kGlobalPlanningTemplate, committed_section("global planning"));
  EXPECT_EQ(block_direction_table(silent), texts.at("block_directions"));
  EXPECT_EQ(block_map_table(silent), texts.at("block_expanded"));
}

/// Files of the pictures that these links of markdown show.
std::vector<std::string> pictures_in(const std::string& links) {
  static const std::regex link(R"(\]\(experiments/([^)]+)\))");
  std::vector<std::string> files;
  for (std::sregex_iterator it(links.begin(), links.end(), link), end; it != end; ++it) files.push_back((*it)[1]);
  return files;
}

TEST(CommittedFigures, OfFusedDrivesHaveEveryPicture) {
  const Texts texts = texts_of(kLocalPlanningTemplate, committed_section("local planning"));
  const std::vector<std::string> curves = pictures_in(texts.at("curve_pictures"));
  const std::vector<std::string> ways = pictures_in(texts.at("way_pictures"));
  EXPECT_THAT(curves, ::testing::UnorderedElementsAreArray(curve_files()));
  EXPECT_FALSE(ways.empty());
  for (const auto& files : {curves, ways})
    for (const std::string& file : files) EXPECT_TRUE(fs::is_regular_file(committed_pictures() / file)) << file;
}

TEST(CommittedFigures, OfWusRollingWindowAreMadeAgain) {
  const Texts texts = texts_of(kLocalPlanningTemplate, committed_section("local planning"));
  const Folder pictures("window");
  const WindowTable window = window_table(pictures.path(), "experiments", silent);
  EXPECT_EQ(window.rows, texts.at("windows"));
  expect_committed(pictures.path());
}

}  // namespace
}  // namespace aisle::lab
