#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tools/lab/page/progress.hpp"
#include "tools/lab/papers/paired.hpp"
#include "tools/lab/papers/plan_measurements.hpp"

namespace aisle::lab {

/// Planners beside each other on the papers' maps, in one run.
struct Comparison {
  std::vector<std::string> map_kinds;  // paper_maps.hpp
  std::vector<std::string> planners;   // of plan_contestant(); the first is the one that the others are compared with
  MapDraw maps;
};

/// One planner on the maps of one kind. Means are over the maps where it found a path; not a number when there is none.
struct ComparedPlanner {
  std::string map_kind;
  std::string planner;
  std::size_t maps{0};
  std::size_t found{0};
  double length_m{0.0};
  double turning_points{0.0};
  double turned_rad{0.0};
  double clearance_m{0.0};   // the least along the path
  double expanded{0.0};      // cells; of OMPL's planners iterations
  double time_us{0.0};       // the only figure that depends on the machine
  PairedComparison lengths;  // of the first planner and of this one, where both found a path
};

/// A list of names as it is typed: words, or words with commas between. @returns every one as plan_contestant() takes
/// it
/// @throws config::BadInput for one that there is not, with the nearest
std::vector<std::string> contestants_named(const std::vector<std::string>& typed);

/// The kinds of maps that a name means: "all", a kind ("wang-1"), or a paper ("wang").
/// @throws config::BadInput with the nearest name
std::vector<std::string> map_kinds_named(const std::string& name);

/// By kinds, then planners.
/// @throws config::BadEnvironment for one of OMPL's planners where it is not built in
std::vector<ComparedPlanner> compare(const Comparison& orders, const Progress& progress);

/// Rows of a table, heading first, with times in microseconds.
std::vector<std::vector<std::string>> rows_of(const std::vector<ComparedPlanner>& compared);

/// One object a row, figures that are not there as null.
nlohmann::ordered_json json_of(const std::vector<ComparedPlanner>& compared, unsigned seed);

/// How many maps comparators_table() takes at most: samples take a thousand times a search on the grid.
inline constexpr int kComparatorMaps = 50;

/// The same for the page: each paper's planner beside OMPL's planners on one kind of its maps; a line that says so when
/// OMPL is not built in.
std::string comparators_table(MapDraw maps, const Progress& progress);

}  // namespace aisle::lab
