#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "bench/queries/sites.hpp"
#include "services/global-planner/core/planner.hpp"

namespace aisle::bench {

/// The answer to one query.
struct Reply {
  bool is_found{false};
  double length_m{0.0};
  std::size_t expanded{0};

  /// To be checked; null for peers that answer with a length only.
  const std::vector<geometry::Point2>* waypoints_in_map{nullptr};
};

/// A planner that answers queries on one map, ours or not. Arrays that it keeps between queries are
/// kept.
struct Contestant {
  std::string name;
  bool is_ours{false};
  bool is_on_grid{true};  // lengths compare with the octile optimum
  std::function<Reply(const lab::Query&)> answer;
};

/// Every variant of ours, "astar+removal" (astar, then passes P1 and P3), a textbook A*, Boost.Graph and OMPL.
std::vector<Contestant> contestants(const Site& site);

}  // namespace aisle::bench
