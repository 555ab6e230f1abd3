#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/grid/clearance.hpp"
#include "tools/lab/planning/queries.hpp"

namespace aisle::bench {

/// A map with its questions. The clearance field looks 2 m far, as the global planner's does.
struct Site {
  std::string name;
  grid::OccupancyGrid grid;
  grid::ClearanceField clearance;
  std::vector<lab::Query> queries;
  bool is_from_ros{false};
  double any_angle_bound{0.0};  // mean of the shortest possible length over the octile optimum; 0: not known
};

/// The nine maps of `data` (folders movingai, ros and queries) that performance.md measures, as far as `only` (a part
/// of the name, empty: all) lets them, with at most `limit` queries each (fewer on large maps); then the largest with
/// starts and goals three cells apart. Without such a folder the shipped warehouse, with random pairs of seed 11.
std::vector<Site> read_sites(const std::filesystem::path& data, const std::string& only, std::size_t limit);

}  // namespace aisle::bench
