#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "services/local-planner/core/critic.hpp"
#include "services/local-planner/core/moment.hpp"
#include "services/local-planner/core/road.hpp"
#include "services/local-planner/core/settings.hpp"
#include "services/local-planner/core/way.hpp"

namespace aisle::local_planner {

/// What the newest plan changed.
struct Adoption {
  bool is_other_goal{false};
  bool has_new_lane{false};
};

/// Makes the plan's turning points the lane of the way, once for each plan and map.
class WayKeeper {
 public:
  /// @param knows_path false: the lane is a straight line to the goal, as for the traditional DWA
  WayKeeper(const Settings& settings, bool knows_path);

  /// A plan says the same as the one before by its goal and turning points, not by its id: ids begin again with each
  /// planner, and the next one keeps the plans that it finds. The lane is made anew for another plan, id or map, and in
  /// a tube when more or less of the road is granted: that is no new lane, the vehicle goes on where it is.
  /// @pre the guard lets the vehicle drive
  Adoption adopt(const Moment& moment, const Road& road, Way& way);

 private:
  /// The lane of the plan: straight to the goal, the plan itself, or rounded.
  Lane lane_of(const Moment& moment, const Road& road) const;

  /// The lane in a tube, where it is another one by now.
  void keep_to_road(const Moment& moment, const Road& road, bool is_other, Way& way);

  LaneSettings lane_;
  bool knows_path_;
  std::uint64_t plan_id_{0};                      // of the lane
  std::uint64_t map_revision_{0};                 // of the lane
  std::uint64_t lane_revision_{0};                // of the road, in a tube
  double tube_m_{0.0};                            // of the lane
  std::vector<geometry::Point2> plan_waypoints_;  // as the plan had them
  std::string goal_id_;
  geometry::Pose2 goal_in_map_;
};

/// Has the vehicle left its lane for good? Far beside it, turned away from it, or past its end. Of a vehicle that turns
/// on the spot, never: it gets back.
bool is_off_path(const Moment& moment, const Way& way);

}  // namespace aisle::local_planner
