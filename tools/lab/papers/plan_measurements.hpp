#pragma once
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "services/global-planner/core/planner.hpp"
#include "tools/lab/page/progress.hpp"
#include "tools/lab/papers/published.hpp"

namespace aisle::lab {

/// A planner that papers compare, by its name in the tables: a variant, or
/// "traditional", "traditional-chebyshev" and "traditional-four" (the baselines as drawn: through obstacles' corners,
/// with the Euclidean and the Chebyshev distance, in four directions), "NAME-without-passes" (a variant without its
/// passes).
/// @pre there is one
std::unique_ptr<global_planner::Planner> plan_contestant(const std::string& name);

/// What QU's and YU's passes keep beside their lines, for a vehicle without size; printed nowhere. The service keeps
/// the same beside the vehicle's outline.
inline constexpr double kPapersSafeDistanceM = 0.3;

/// Which maps: those of seeds (seed - 1) * maps + 1 to seed * maps of each kind.
struct MapDraw {
  int maps{200};
  unsigned seed{1};
  unsigned first() const { return (seed - 1) * static_cast<unsigned>(maps) + 1; }
};

/// Figures of planners on the maps of one kind, map by map; all planners on a map after another, so that times are of
/// the same run. Times are the least of some runs.
class PlanMeasurements {
 public:
  PlanMeasurements(const MapDraw& draw, Progress progress) : draw_(draw), progress_(std::move(progress)) {}

  /// One figure a map. kTime in microseconds. @pre there are such a kind and planner
  const std::vector<double>& of(const std::string& map_kind, const std::string& planner, PlanFigure figure);

 private:
  using Figures = std::map<PlanFigure, std::vector<double>>;
  void measure(const std::string& map_kind);

  MapDraw draw_;
  Progress progress_;
  std::map<std::string, std::map<std::string, Figures>> measured_;  // by kind and planner
};

}  // namespace aisle::lab
