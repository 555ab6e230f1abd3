#include "services/local-planner/core/way_keeping.hpp"

#include <cmath>
#include <utility>

namespace aisle::local_planner {
namespace {

constexpr double kStepM = 0.2;       // between the lane's points
constexpr double kSameGoalM = 1e-6;  // apart are goals that are the same
constexpr double kOffPathM = 0.6;    // so far beside its lane a vehicle that cannot turn on the spot is off it,
constexpr double kOffPathRad = 1.2;  // or turned so far from it,
constexpr double kAtEndM = 0.05;     // or at its end, with the last point behind it

}  // namespace

WayKeeper::WayKeeper(const Settings& settings, bool knows_path) : lane_(settings.lane), knows_path_(knows_path) {
  if (!settings.slows_on_the_way) lane_.roomy_m = 0.0;
}

Adoption WayKeeper::adopt(const Moment& moment, const Road& road, Way& way) {
  const Plan& plan = *moment.inputs.plan;
  const bool is_other_goal = plan.goal_id != goal_id_ ||
                             geometry::distance(plan.goal_in_map.position(), goal_in_map_.position()) > kSameGoalM ||
                             plan.goal_in_map.yaw != goal_in_map_.yaw;
  if (is_other_goal || road.tube_m() > 0.0) way.come_back();

  // The same plan for the same map has its lane already.
  const bool is_same_plan = !is_other_goal && plan.waypoints_in_map == plan_waypoints_ && !way.empty();
  const bool is_same_lane =
      is_same_plan && plan.id == plan_id_ && map_revision_ == moment.inputs.map_revision && road.tube_m() == tube_m_;
  if (road.tube_m() > 0.0) keep_to_road(moment, road, !is_same_lane, way);
  if (is_same_lane) return {is_other_goal, false};

  goal_id_ = plan.goal_id;
  goal_in_map_ = plan.goal_in_map;
  plan_id_ = plan.id;
  plan_waypoints_ = plan.waypoints_in_map;
  map_revision_ = moment.inputs.map_revision;

  tube_m_ = road.tube_m();
  if (tube_m_ == 0.0) way.adopt(lane_of(moment, road), moment.here(), is_same_plan);

  return {is_other_goal, true};
}

void WayKeeper::keep_to_road(const Moment& moment, const Road& road, bool is_other, Way& way) {
  if (!is_other && lane_revision_ == road.lane_revision()) return;
  lane_revision_ = road.lane_revision();
  way.adopt_at(road.lane(), moment.here(), road.progress_m());
}

/// A vehicle that cannot turn on the spot drives its plan as it is: the plan's arcs are the tightest that it should
/// drive.
Lane WayKeeper::lane_of(const Moment& moment, const Road& road) const {
  const std::vector<geometry::Point2>& plan = moment.inputs.plan->waypoints_in_map;
  if (!knows_path_) return Lane(Route(resample({moment.here(), plan.back()}, kStepM)));

  // A plan with steps may begin behind the vehicle, and turn back where it is.
  const double from_m = road.has_steps() ? road.progress_m() : 0.0;
  const std::vector<geometry::Point2> waypoints = from_m > 0.0 ? road.way().part(from_m, road.way().length_m()) : plan;
  Lane lane = moment.vehicle.turns_on_the_spot()
                  ? make_lane(waypoints, *moment.inputs.clearance, moment.vehicle.reach_m(), lane_)
                  : Lane(Route(resample(waypoints, kStepM)));
  for (double& along_m : lane.plan_m) along_m += from_m;

  return lane;
}

bool is_off_path(const Moment& moment, const Way& way) {
  if (moment.vehicle.turns_on_the_spot()) return false;

  const Route& lane = way.lane();
  const double s_m = way.lane_s_m();

  const geometry::Pose2& base = moment.motion.base_now;
  const double turned_rad = std::abs(geometry::wrap(lane.heading_at(s_m) - base.yaw));
  const bool is_past_the_end =
      lane.length_m() - s_m < kAtEndM && geometry::from_map(base, lane.points().back()).x < 0.0;

  return geometry::distance(moment.here(), lane.at(s_m)) > kOffPathM || turned_rad > kOffPathRad || is_past_the_end;
}

}  // namespace aisle::local_planner
