#include "bench/queries/contestants.hpp"

#include <utility>

#include "bench/peers/textbook_astar.hpp"
#ifdef AISLE_BENCH_BOOST
#include "bench/peers/boost_astar.hpp"
#endif
#include "services/global-planner/core/drivable.hpp"
#include "services/global-planner/core/passes/passes.hpp"
#include "services/global-planner/core/variant.hpp"
#include "tools/lab/planning/ompl_planners.hpp"

namespace aisle::bench {
namespace {

namespace planning = global_planner;

using Pass = void (*)(const planning::Drivable&, std::vector<geometry::Point2>&);

/// Kept from query to query.
struct Asked {
  std::unique_ptr<planning::Planner> planner;
  planning::PlannedPath plan;
};

/// A planner, with passes over its path.
Contestant contestant(const Site& site, std::unique_ptr<planning::Planner> planner, const std::string& name,
                      std::vector<Pass> then) {
  auto state = std::make_shared<Asked>();
  state->planner = std::move(planner);

  const auto answer = [&site, state, then = std::move(then)](const lab::Query& query) {
    const planning::Problem problem{site.clearance, query.start_in_map, query.goal_in_map};
    state->planner->plan(problem, nullptr, state->plan);

    if (!then.empty() && state->plan.outcome == planning::Outcome::kFound) {
      const planning::Drivable drivable(problem);
      for (const Pass pass : then) pass(drivable, state->plan.waypoints_in_map);
      state->plan.length_m = planning::path_length_m(state->plan.waypoints_in_map);
    }

    return Reply{state->plan.outcome == planning::Outcome::kFound, state->plan.length_m, state->plan.expanded,
                 &state->plan.waypoints_in_map};
  };

  return {name, true, true, answer};
}

/// OMPL's, until its first path.
Contestant ompl(const Site& site, const std::string& name) {
  lab::SamplingBounds bounds;
  bounds.seconds = 0.5;
  bounds.ends_at_first_path = true;

  Contestant peer = contestant(site, lab::ompl_planner(name, bounds), "ompl " + name, {});
  peer.is_ours = peer.is_on_grid = false;
  return peer;
}

/// Cells to metres.
Reply reply_of(const PeerAnswer& answer, const Site& site) {
  return {answer.is_found, answer.length_cells * site.grid.geometry().resolution_m, answer.expanded, nullptr};
}

}  // namespace

/// The textbook first: the others are compared with it.
std::vector<Contestant> contestants(const Site& site) {
  std::vector<Contestant> all;
  const auto cell = [&site](geometry::Point2 p) { return site.grid.geometry().cell_at(p); };
  all.push_back({"textbook", false, true, [&site, cell](const lab::Query& query) {
                   return reply_of(textbook_astar(site.grid, cell(query.start_in_map), cell(query.goal_in_map)), site);
                 }});
#ifdef AISLE_BENCH_BOOST
  const auto boost = std::make_shared<BoostAstar>(site.grid);
  all.push_back({"boost", false, true, [&site, cell, boost](const lab::Query& query) {
                   return reply_of(boost->plan(cell(query.start_in_map), cell(query.goal_in_map)), site);
                 }});
#endif
  for (const planning::Variant& variant : planning::all_variants()) {
    all.push_back(contestant(site, variant.make(), variant.name, {}));

    if (variant.name == "astar") {
      all.push_back(contestant(site, variant.make(), "astar+removal",
                               {planning::passes::collinear, planning::passes::greedy_line_of_sight}));
    }
  }

  if (!lab::ompl_version().empty()) {
    for (const char* name : {"rrtconnect", "bitstar"}) all.push_back(ompl(site, name));
  }

  return all;
}

}  // namespace aisle::bench
