#pragma once
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "services/global-planner/core/planner.hpp"
#include "tools/lab/page/progress.hpp"
#include "tools/lab/papers/published.hpp"

namespace aisle::lab {

/// A planner that papers compare, by its name in the tables: a variant, or
/// "traditional", "traditional-chebyshev" and "traditional-four" (the baselines as drawn: through obstacles' corners,
/// with the Euclidean and the Chebyshev distance, in four directions), "NAME-without-passes" (a variant without its
/// passes), and OMPL's (ompl_planners.hpp), each with kSamplingIterations.
/// @pre there is one; @throws config::BadEnvironment for one of OMPL's where it is not built in
std::unique_ptr<global_planner::Planner> plan_contestant(const std::string& name);

/// Every name of plan_contestant() but those without passes.
std::vector<std::string> plan_contestant_names();

/// Of OMPL's planners, whatever the map: figures repeat, as they would not with a bound in seconds.
inline constexpr std::size_t kSamplingIterations = 2000;

/// What QU's and YU's passes keep beside their lines, for a vehicle without size; printed nowhere. The service keeps
/// the same beside the vehicle's outline.
inline constexpr double kPapersSafeDistanceM = 0.3;

/// Which maps: those of seeds (seed - 1) * maps + 1 to seed * maps of each kind.
struct MapDraw {
  int maps{200};
  unsigned seed{1};
  unsigned first() const { return (seed - 1) * static_cast<unsigned>(maps) + 1; }
};

/// One figure a map; not a number where the planner found no path.
using PlanFigures = std::map<PlanFigure, std::vector<double>>;

/// A planner is timed so often on a map, and the least time counts; one that takes longer than kLongPlanUs twice only.
inline constexpr int kTimedRuns = 5;
inline constexpr double kLongPlanUs = 5000.0;

/// Figures of these planners on the maps of one kind, map by map: all of them on a map after another, so that times
/// (microseconds, the least of some runs) are of the same run. @pre there are such a kind and planners
std::map<std::string, PlanFigures> measure_plans(const std::string& map_kind, const std::set<std::string>& planners,
                                                 const MapDraw& draw);

/// Figures of all planners that the papers' tables have on the maps of one kind; made when they are asked for.
class PlanMeasurements {
 public:
  PlanMeasurements(const MapDraw& draw, Progress progress) : draw_(draw), progress_(std::move(progress)) {}

  /// One figure a map. kTime in microseconds. @pre there are such a kind and planner
  const std::vector<double>& of(const std::string& map_kind, const std::string& planner, PlanFigure figure);

 private:
  MapDraw draw_;
  Progress progress_;
  std::map<std::string, std::map<std::string, PlanFigures>> measured_;  // by kind and planner
};

}  // namespace aisle::lab
