// Every scenario of every .scen file of the reference data against the optimum that the file gives. Without the data:
// skipped. The same by command: aisle plan --map M.map --scen M.scen --planner astar jps
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <ostream>
#include <string>
#include <vector>

#include "common/config/reader.hpp"
#include "common/grid/formats/map_file.hpp"
#include "common/scenario/data_path.hpp"
#include "services/global-planner/core/variant.hpp"
#include "tests/support/places.hpp"
#include "tools/lab/planning/queries.hpp"
#include "tools/lab/planning/tally.hpp"

namespace aisle::lab {
namespace {

namespace fs = std::filesystem;

/// Empty when the reference data is not there.
std::vector<fs::path> scenario_files() {
  std::vector<fs::path> files;
  try {
    const fs::path one = scenario::find_named_file("data:movingai/den520d.map",
                                                   test_support::source_folder() / "deploy/scenarios/any.yaml");
    for (const auto& entry : fs::directory_iterator(one.parent_path())) {
      if (entry.path().extension() == ".scen") files.push_back(entry.path());
    }
  } catch (const config::BadInput&) {
  }
  std::sort(files.begin(), files.end());
  return files;
}

/// den520d-even-1.scen, den520d.map.scen -> den520d.map
fs::path map_of(const fs::path& scenarios) {
  fs::path best;
  for (const auto& entry : fs::directory_iterator(scenarios.parent_path())) {
    const bool is_map =
        entry.path().extension() == ".map" && scenarios.filename().string().rfind(entry.path().stem().string(), 0) == 0;
    if (is_map && entry.path().string().size() > best.string().size()) best = entry.path();
  }
  return best;
}

struct Promise {
  const char* planner;
  std::size_t at_most;  // scenarios a file, evenly spread; astar and jps take all, in a few seconds
  double least, most;   // length over the file's optimum
};

void PrintTo(const Promise& promise, std::ostream* out) { *out << promise.planner; }

class Optimum : public testing::TestWithParam<Promise> {};

TEST_P(Optimum, HoldsOnTheReferenceScenarios) {
  const Promise& promise = GetParam();
  const std::vector<fs::path> files = scenario_files();
  if (files.empty()) GTEST_SKIP() << "no reference data";
  const auto planner = global_planner::find_variant(promise.planner)->make();
  int asked = 0;
  for (const fs::path& file : files) {
    const grid::OccupancyGrid grid = grid::read_map_file(map_of(file));
    const grid::ClearanceField clearance(grid, 5.0);
    for (const Query& query : read_queries(file, grid.geometry(), promise.at_most)) {
      const Answer answer = ask(*planner, {clearance, query.start_in_map, query.goal_in_map});
      ++asked;
      ASSERT_EQ(answer.plan.outcome, global_planner::Outcome::kFound) << file << ", scenario " << asked;
      ASSERT_EQ(answer.fault, "") << file;
      // Older files keep six significant digits.
      ASSERT_LE(answer.figures.length_m, promise.most * query.optimum_m + 1e-9) << file;
      ASSERT_GE(answer.figures.length_m, promise.least * query.optimum_m - 1e-9) << file;
    }
  }
  RecordProperty("scenarios", asked);
  EXPECT_GT(asked, 500);
}

INSTANTIATE_TEST_SUITE_P(Planners, Optimum,
                         testing::Values(Promise{"astar", 100000, 1.0 - 1e-5, 1.0 + 1e-5},
                                         Promise{"jps", 100000, 1.0 - 1e-5, 1.0 + 1e-5},
                                         Promise{"dijkstra", 100, 1.0 - 1e-5, 1.0 + 1e-5},
                                         Promise{"theta", 40, 0.7, 1.0 + 1e-5}, Promise{"direct", 100, 0.7, 1.0 + 1e-5},
                                         Promise{"wu", 100, 0.7, 1.0 + 1e-5}, Promise{"qu", 100, 0.7, 1.0 + 1e-5},
                                         Promise{"li", 100, 0.7, 10.0}, Promise{"yu", 100, 0.7, 10.0},
                                         Promise{"wang", 100, 0.7, 10.0}, Promise{"greedy", 100, 0.99, 100.0},
                                         Promise{"modified-astar", 100, 0.99, 10.0}),
                         [](const auto& promise) {
                           std::string name = promise.param.planner;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

}  // namespace
}  // namespace aisle::lab
