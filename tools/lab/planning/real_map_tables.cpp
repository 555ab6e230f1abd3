#include "tools/lab/planning/real_map_tables.hpp"

#include <vector>

#include "common/grid/formats/map_file.hpp"
#include "services/global-planner/core/variant.hpp"
#include "tools/lab/page/markdown.hpp"
#include "tools/lab/planning/queries.hpp"
#include "tools/lab/planning/tally.hpp"

namespace aisle::lab {
namespace {

/// A map of the reference data.
struct RealMap {
  const char* name;
  bool is_ros;
  double any_angle;  // shortest any-angle length over the 8-connected optimum, mean of all 200 queries; 0: not known
};

constexpr RealMap kMaps[]{{"warehouse-10-20-10-2-1", false, 0.9422},
                          {"room-64-64-16", false, 0.9160},
                          {"random-64-64-20", false, 0.8938},
                          {"maze-128-128-10", false, 0.9362},
                          {"den520d", false, 0.9442},
                          {"Berlin_1_256", false, 0.9385},
                          {"willow-full", true, 0.9547},
                          {"nav2_depot", true, 0.9514},
                          {"nav2_warehouse", true, 0.9516},
                          {"nav2_tb3_sandbox", true, 0.0},
                          {"aws_small_warehouse_005", true, 0.0}};

constexpr double kRadius_m = 0.3;        // of the vehicle on the ROS maps
constexpr double kFarthestLook_m = 5.0;  // clearances are known this far

/// A row for each planner over all queries that this radius can drive at all. For a point the file knows the optimum,
/// for a disc jump points find it.
std::string table_of(const grid::ClearanceField& clearance, const std::vector<Query>& queries, double radius_m,
                     const std::string& what, const Progress& progress) {
  std::vector<std::vector<std::string>> table{{"planner", "asked", "solved", "faults", "length/optimum", "max", "nodes",
                                               "turns", "turned rad", "expanded", "least clearance m"}};
  std::vector<double> optimum_m;
  const auto jps = global_planner::find_variant("jps")->make();

  for (const Query& query : queries) {
    optimum_m.push_back(
        radius_m == 0.0 ? query.optimum_m
                        : jps->plan({clearance, query.start_in_map, query.goal_in_map, radius_m}, nullptr).length_m);
  }

  for (const global_planner::Variant& variant : global_planner::all_variants()) {
    if (variant.name == "hybrid") continue;  // as theta without headings

    progress(what + ": " + variant.name);

    const auto planner = variant.make();
    Tally tally(variant.name);

    for (std::size_t i = 0; i < queries.size(); ++i) {
      if (optimum_m[i] > 0.0)
        tally.add(ask(*planner, {clearance, queries[i].start_in_map, queries[i].goal_in_map, radius_m}), optimum_m[i]);
    }

    table.push_back({variant.name, std::to_string(tally.asked()), std::to_string(tally.solved()),
                     std::to_string(tally.checker_failures()), digits(tally.length_ratio_mean(), 4),
                     digits(tally.length_ratio_max(), 4), digits(tally.nodes_mean(), 1),
                     digits(tally.turning_points_mean(), 1), digits(tally.turning_angle_mean_rad(), 1),
                     digits(tally.expanded_mean(), 0), digits(tally.least_clearance_m(), 3)});
  }

  return markdown_table(table);
}

}  // namespace

/// The same queries for every planner.
std::string real_map_tables(const std::filesystem::path& data, int queries, const Progress& progress) {
  std::string text;
  for (const RealMap& map : kMaps) {
    const std::string name = map.name;
    const grid::OccupancyGrid grid =
        grid::read_map_file(map.is_ros ? data / "ros" / (name + ".yaml") : data / "movingai" / (name + ".map"));
    const grid::ClearanceField clearance(grid, kFarthestLook_m);
    const std::vector<Query> some =
        read_queries(data / "queries" / (name + ".q"), grid.geometry(), static_cast<std::size_t>(queries));

    text += "#### " + name + ", for a point\n\n";

    if (map.any_angle > 0.0)
      text +=
          "Shortest any-angle length over the optimum (mean of the file's 200 queries): " + digits(map.any_angle, 4) +
          ".\n\n";

    text += table_of(clearance, some, 0.0, name, progress);

    if (map.is_ros)
      text += "#### " + name + ", radius 0.3 m\n\n" +
              table_of(clearance, some, kRadius_m, name + ", radius 0.3 m", progress);
  }

  return text;
}

}  // namespace aisle::lab
