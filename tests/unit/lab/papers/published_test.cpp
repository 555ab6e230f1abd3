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
using testing::HasSubstr;
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

/// "planner < reference: figure", by what the row is measured.
std::string measured(const std::string& table, const std::string& name) {
  const Evidence& evidence = row_of(table, name).evidence;
  const auto text = [](const char* ours, const char* reference) {
    return std::string(ours) + " against " + (reference != nullptr ? reference : "none");
  };
  if (const auto* plan = std::get_if<PlanEvidence>(&evidence)) return text(plan->planner, plan->reference);
  if (const auto* drive = std::get_if<DriveEvidence>(&evidence)) return text(drive->contestant, drive->reference);
  return "not measured";
}

PlanFigure plan_figure(const std::string& table, const std::string& name) {
  return std::get<PlanEvidence>(row_of(table, name).evidence).figure;
}

DriveFigure drive_figure(const std::string& table, const std::string& name) {
  return std::get<DriveEvidence>(row_of(table, name).evidence).figure;
}

// A row of the right name that measures another figure would pass all other tests.
TEST(PublishedRows, OfPathsAreMeasuredByWhatThePaperMeans) {
  EXPECT_EQ(plan_figure("LI II", "Simple environment, Improved A* algorithm: vertices"), PlanFigure::kTurns);
  EXPECT_EQ(plan_figure("LI V", "Ant Colony Algorithm: vertices"), PlanFigure::kTurns);
  EXPECT_EQ(measured("LI II", "Complex environment, Improved A* algorithm: path length"),
            "li against traditional-four");
  EXPECT_EQ(measured("LI V", "Ant Colony Algorithm: path length"), "ant-colony against li");
  EXPECT_EQ(measured("WU figure 8", "improved A*: turns"), "wu against traditional");
  const char* const safer = "the path of the improved algorithm is safer, the other is closer to the obstacle";
  EXPECT_EQ(plan_figure("QU figure 5", safer), PlanFigure::kClearance);
  EXPECT_EQ(measured("QU figure 5", safer), "qu against traditional");
  for (const char* table : {"YU 2", "YU 3", "YU 4"}) {
    EXPECT_EQ(measured(table, "A* algorithm with improved heuristic function: path length, m"),
              "yu-without-passes against traditional");
    EXPECT_EQ(
        plan_figure(table,
                    "A* algorithm with improved heuristic function and optimized folds: number of nodes traversed"),
        PlanFigure::kExpanded);
  }
  EXPECT_EQ(measured("WANG 1", "Improved A* Algorithm: search scope, m2"),
            "wang-without-passes against traditional-chebyshev");
  EXPECT_EQ(plan_figure("WANG 1", "Modified A* Algorithm: planning time"), PlanFigure::kTime);
  EXPECT_EQ(plan_figure("WANG 2", "Improved A* algorithm: number of path nodes"), PlanFigure::kNodes);
}

TEST(PublishedRows, OfDrivesAreMeasuredByWhatThePaperMeans) {
  EXPECT_EQ(drive_figure("LI IV", "Final path: number of inflection points"), DriveFigure::kSharpTurns);
  EXPECT_EQ(drive_figure("WU figure 9", "the local path is closer to the global path"), DriveFigure::kDistanceToPath);
  const char* const figures = "WU figures 10 and 11";
  const char* const slower = "line speed near the obstacle, m/s, original -> improved";
  EXPECT_EQ(drive_figure(figures, slower), DriveFigure::kSpeedNear);
  EXPECT_EQ(measured(figures, slower), "improved against improved-traditional") << "the critics alone differ";
  EXPECT_EQ(drive_figure(figures, "angular velocity, rad/s, original -> improved"), DriveFigure::kRangeOfW);
  for (const char* table : {"YU 5", "YU 6"}) {
    const std::string length = "In this paper, we improve the A* algorithm to fuse DWA: path length, m";
    EXPECT_EQ(measured(table, length), "improved against dwa-own") << "shorter than the DWA alone, with YU's weights";
    EXPECT_EQ(drive_figure(table, length), DriveFigure::kLength);
    EXPECT_EQ(measured(table, "Improved A* Fusion DWA proposed by Wu 2020: path length, m"), "not measured");
  }
  EXPECT_EQ(drive_figure("QU figure 8", "linear velocity falls while two movers are avoided"),
            DriveFigure::kSpeedNearMover);
  EXPECT_EQ(drive_figure("QU figure 8", "angular velocity falls while two movers are avoided"),
            DriveFigure::kTurnNearMover);
  EXPECT_EQ(drive_figure("WANG figure 6", "linear velocity changes less"), DriveFigure::kChangesOfV);
  EXPECT_EQ(drive_figure("WANG figure 7", "angular velocity changes less"), DriveFigure::kChangesOfW);
  for (const char* map : {"Map 1", "Map 2", "Map 3"}) {
    EXPECT_EQ(drive_figure("WANG section 5.3", std::string(map) + ": path length, m"), DriveFigure::kLength);
    EXPECT_EQ(drive_figure("WANG section 5.3", std::string(map) + ": path-planning time, s"), DriveFigure::kTime);
  }
}

TEST(PublishedRows, SayWhereAPaperContradictsItself) {
  const auto note = [](const char* table, const char* name) { return row_of(table, name).note; };
  EXPECT_THAT(note("LI section V.A", "shorter path, both environments"), HasSubstr("17.61 and 21.45 %"));
  EXPECT_THAT(note("LI section V.A", "less planning time, both environments"), HasSubstr("28.74 and 51.81 %"));
  const char* const ratio = "Map 1, Improving the A* algorithm: path length optimization ratio";
  EXPECT_THAT(note("QU 2", ratio), HasSubstr("14.13 %"));
  EXPECT_THAT(note("QU 3", "Map 1, one mover: path length optimization ratio"), HasSubstr("14.11 %"));
  EXPECT_THAT(note("QU 3", "Map 1, two movers: path length optimization ratio"), HasSubstr("12.09 %"));
  EXPECT_THAT(note("YU 5", "Dynamic Window Approach: path length, m"), HasSubstr("repeats table 2"));
  EXPECT_THAT(note("YU section 5", "conclusion: shorter than the A* algorithm"), HasSubstr("no pair"));
  const char* const wang = "WANG sections 5.1 and 5.2";
  EXPECT_THAT(note(wang, "planning time less than the modified A*'s"), HasSubstr("swapped"));
  EXPECT_THAT(note(wang, "search scope less than the modified A*'s"), HasSubstr("swapped"));
  EXPECT_THAT(note("WANG 1", "Modified A* Algorithm: planning time"), HasSubstr("0.076 s"));
  EXPECT_THAT(note("WANG 1", "Modified A* Algorithm: search scope, m2"), HasSubstr("228"));
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

// WANG, table 2: one dynamic window after two paths; YU, tables 5 and 6: one table of weights for all four.
TEST(PublishedRows, CompareFusionsOfWangAndYuThatDifferInThePathAlone) {
  for (const PublishedRow& row : published_rows()) {
    const auto* drive = std::get_if<DriveEvidence>(&row.evidence);
    if (drive == nullptr || (row.table.rfind("WANG", 0) != 0 && row.table.rfind("YU", 0) != 0)) continue;
    for (const char* contestant : {drive->contestant, drive->reference}) {
      if (contestant == nullptr) continue;
      EXPECT_THAT((std::vector<std::string>{"improved", "astar-own", "dwa-own", "improved-plan", "traditional-plan"}),
                  Contains(contestant))
          << row.table << ", " << row.row;
    }
  }
}

// Compared with itself a row differs by nothing, whatever the code does.
TEST(PublishedRows, AreNotComparedWithThemselves) {
  for (const PublishedRow& row : published_rows()) {
    const auto* plan = std::get_if<PlanEvidence>(&row.evidence);
    const auto* drive = std::get_if<DriveEvidence>(&row.evidence);
    const std::string ours = plan != nullptr ? plan->planner : drive != nullptr ? drive->contestant : "";
    const char* const reference = plan != nullptr ? plan->reference : drive != nullptr ? drive->reference : nullptr;
    if (reference != nullptr) {
      EXPECT_NE(ours, reference) << row.table << ", " << row.row;
    }
  }
  const char* const reason = "it is what the others are compared with";
  EXPECT_EQ(std::get<NoEvidence>(row_of("WU 2", "Tradition A*: Smooth Path").evidence).why, reason);
}

// WU's table 2 says one comparison twice: of the traditional DWA and of the improved one.
TEST(PublishedRows, CountTheComparisonOfWusWindowsOnce) {
  for (const char* property : {"Smooth Path", "Deceleration Obstacle Avoidance"}) {
    EXPECT_TRUE(row_of("WU 2", std::string("Tradition DWA: ") + property).is_reference) << property;
    EXPECT_FALSE(row_of("WU 2", std::string("Improved DWA: ") + property).is_reference) << property;
  }
}

// Our own slowing before bends and walls would hide what eq. 10 does.
TEST(PublishedRows, OfLisSlowingAreMeasuredByItsCriticsAlone) {
  EXPECT_EQ(rows_of("LI section IV.C"), 2U);
  for (const PublishedRow& row : published_rows()) {
    if (row.table != "LI section IV.C") continue;
    const auto& drive = std::get<DriveEvidence>(row.evidence);
    EXPECT_STREQ(drive.contestant, "improved-by-critics");
    EXPECT_STREQ(drive.reference, "improved-traditional-by-critics");
    EXPECT_EQ(row.claim, ClaimedDirection::kLess);
  }
}

}  // namespace
}  // namespace aisle::lab
