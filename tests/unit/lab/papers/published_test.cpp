// The papers' tables as data: none left out, every row of each, every contestant and map there is.
#include "tools/lab/papers/published.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <set>
#include <string>

#include "tools/lab/driving/window_cases.hpp"
#include "tools/lab/papers/drive_measurements.hpp"
#include "tools/lab/papers/plan_measurements.hpp"
#include "tools/lab/planning/paper_maps.hpp"

namespace aisle::lab {
namespace {

using testing::Contains;
using testing::IsSupersetOf;
using testing::StartsWith;

std::size_t rows_of(const std::string& table) {
  const auto& rows = published_rows();
  return static_cast<std::size_t>(
      std::count_if(rows.begin(), rows.end(), [&](const PublishedRow& row) { return row.table == table; }));
}

const PublishedRow& row_of(const std::string& table, const std::string& name) {
  for (const PublishedRow& row : published_rows())
    if (row.table == table && row.row == name) return row;
  ADD_FAILURE() << table << " has no row " << name;
  return published_rows().front();
}

TEST(PublishedTables, AreAllOfTheFivePapers) {
  EXPECT_THAT(published_tables(),
              IsSupersetOf({"LI I",         "LI II",        "LI III",       "LI IV",        "LI V",
                            "WU 1",         "WU 2",         "WU figure 8",  "WU figure 9",  "WU figures 10 and 11",
                            "WU figure 12", "WU figure 13", "WU figure 14", "WU figure 15", "QU 1",
                            "QU 2",         "QU 3",         "QU figure 8",  "YU 1",         "YU 2",
                            "YU 3",         "YU 4",         "YU 5",         "YU 6",         "YU 7",
                            "YU figure 7a", "WANG 1",       "WANG 2",       "WANG 3",       "WANG figure 6",
                            "WANG figure 7"}));
}

// Rows times columns, as printed.
TEST(PublishedTables, HaveEveryRowAndColumn) {
  EXPECT_EQ(rows_of("LI I"), 2U);
  EXPECT_EQ(rows_of("LI II"), 4U * 3U);
  EXPECT_EQ(rows_of("LI III"), 5U);
  EXPECT_EQ(rows_of("LI IV"), 2U * 3U);
  EXPECT_EQ(rows_of("LI V"), 2U * 3U);
  EXPECT_EQ(rows_of("WU 1"), 10U) << "four of its six lines hold two numbers";
  EXPECT_EQ(rows_of("WU 2"), 5U * 5U);
  EXPECT_EQ(rows_of("QU 1"), 10U) << "one of its eleven lines is printed twice";
  EXPECT_EQ(rows_of("QU 2"), 4U * 2U + 2U * 2U) << "the ratios stand in the improved rows only";
  EXPECT_EQ(rows_of("QU 3"), 4U * 3U);
  EXPECT_EQ(rows_of("YU 1"), 7U);
  for (const char* table : {"YU 2", "YU 3", "YU 4"}) EXPECT_EQ(rows_of(table), 4U * 4U) << table;
  for (const char* table : {"YU 5", "YU 6"}) EXPECT_EQ(rows_of(table), 4U * 2U) << table;
  EXPECT_EQ(rows_of("YU 7"), 3U);
  EXPECT_EQ(rows_of("WANG 1"), 3U * 3U);
  EXPECT_EQ(rows_of("WANG 2"), 2U * 4U + 2U * 2U) << "the fused rows have no nodes and no turns";
  EXPECT_EQ(rows_of("WANG 3"), 3U * 4U);
}

TEST(PublishedRows, AreAsPrinted) {
  EXPECT_EQ(row_of("WANG 2", "Improved A* algorithm: path length, m").published, "28.53");
  EXPECT_EQ(row_of("WANG 2", "Improved A* algorithm: path length, m").claim, ClaimedDirection::kLess);
  EXPECT_EQ(row_of("YU 3", "A* algorithm with improved heuristic function and optimized folds: path length, m").claim,
            ClaimedDirection::kMore)
      << "its scene 2 is longer, and says so";
  EXPECT_EQ(row_of("WANG 1", "Improved A* Algorithm: path length, m").claim, ClaimedDirection::kEqual);
  EXPECT_NEAR(row_of("WANG 1", "Improved A* Algorithm: planning time").printed_ratio, 0.75, 1e-9);
  EXPECT_TRUE(row_of("LI V", "Improved A* algorithm: path length").is_reference);
}

TEST(PublishedRows, BeginWithTheirPaperAndStandOnce) {
  std::set<std::pair<std::string, std::string>> seen;
  for (const PublishedRow& row : published_rows()) {
    const std::string paper = row.table.substr(0, row.table.find(' '));
    EXPECT_THAT((std::vector<std::string>{"LI", "WU", "QU", "YU", "WANG"}), Contains(paper)) << row.table;
    EXPECT_TRUE(seen.insert({row.table, row.row}).second) << row.table << ", " << row.row;
    EXPECT_FALSE(row.published.empty()) << row.row;
    if (const auto* none = std::get_if<NoEvidence>(&row.evidence)) {
      EXPECT_FALSE(none->why.empty()) << row.row;
    }
  }
}

TEST(PublishedRows, AreMadeFromWhatThereIs) {
  std::set<std::string> scenes, windows;
  for (const DriveScene& scene : drive_scenes()) {
    scenes.insert(scene.name);
    EXPECT_NE(find_paper_map_kind(scene.map), nullptr) << scene.name;
  }
  for (const WindowCase& of : window_cases()) windows.insert(of.name);
  for (const PublishedRow& row : published_rows()) {
    if (const auto* plan = std::get_if<PlanEvidence>(&row.evidence)) {
      EXPECT_NE(plan_contestant(plan->planner), nullptr);
      if (plan->reference != nullptr) {
        EXPECT_NE(plan_contestant(plan->reference), nullptr);
      }
    }
    if (const auto* drive = std::get_if<DriveEvidence>(&row.evidence)) {
      EXPECT_EQ(scenes.count(drive->scene), 1U) << row.row;
    }
    if (const auto* window = std::get_if<WindowEvidence>(&row.evidence)) {
      EXPECT_EQ(windows.count(window->name), 1U);
    }
  }
}

}  // namespace
}  // namespace aisle::lab
