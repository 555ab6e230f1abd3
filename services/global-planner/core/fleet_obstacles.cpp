// What stands in a vehicle's way and is in no map: static tracks, parked and silent vehicles, its own reports.
#include <algorithm>
#include <limits>

#include "services/global-planner/core/fleet_planner.hpp"

namespace aisle::global_planner {
namespace {

using geometry::Point2;
using time::from_seconds;
using time::Stamp;

constexpr double kSmallest_m = 0.05;  // a disc smaller than this is not worth a detour
constexpr double kSample_m = 0.1;     // along a path
constexpr double kNearBlock_m = 2.0;  // a vehicle within this of the reported block is the one that blocks

}  // namespace

// Silent, or standing for long with nothing to do, or staying by its own word.
bool FleetPlanner::is_parked(const VehicleEntry& v, Stamp now) const {
  if (!v.pose.seen() || !v.radius_m) return false;
  if (v.pose.fresh(now, from_seconds(settings_.state_life_s)) == nullptr)
    return true;  // silent: where it was, it may still be

  if (now - v.stands_since < from_seconds(settings_.parked_after_s)) return false;

  const bool has_nothing_to_do =
      !v.goal || v.goal->is_cancelled || (v.plan && v.planned_for == *v.goal && !v.plan->is_found());
  const bool stays =
      v.navigation && (v.navigation->phase == Phase::kFailed || v.navigation->phase == Phase::kHeld ||
                       (v.navigation->phase == Phase::kArrived && v.goal && v.navigation->goal_id == v.goal->id));

  return has_nothing_to_do || stays;
}

bool FleetPlanner::is_blocked_on_its_plan(const VehicleEntry& v, Stamp now) const {
  return v.navigation && v.plan && v.navigation->phase == Phase::kBlocked && v.navigation->plan_id == v.plan->id &&
         now - v.navigation_arrived <= from_seconds(settings_.state_life_s);
}

// Static tracks and reported blocks as they are; vehicles that are parked; and the vehicle that a blocked one waits
// for.
std::vector<FleetPlanner::Obstacle> FleetPlanner::obstacles_for(const VehicleEntry& v, Stamp now) const {
  if (settings_.as_printed) return {};
  const Point2 here = v.pose.any()->position();
  const Point2 goal = v.goal->pose_in_map.position();
  const double slack_m = 1.5 * clearance_.geometry().resolution_m;  // stamping a disc into cells makes it larger

  std::vector<Obstacle> obstacles;
  const auto add = [&](Disc disc, PlanTrigger trigger, const std::string& name) {
    // The vehicle stands where it stands, so the obstacle cannot reach there; and what stands on the goal is left to
    // the local planner.
    disc.radius_m = std::min(disc.radius_m, geometry::distance(here, disc.center_in_map) - *v.radius_m - slack_m);
    if (disc.radius_m < kSmallest_m ||
        geometry::distance(goal, disc.center_in_map) < disc.radius_m + *v.radius_m + slack_m)
      return;

    if (is_in_map(clearance_.geometry(), disc.center_in_map)) obstacles.push_back({disc, trigger, name});
  };

  for (const auto& [id, disc] : static_tracks_) add(disc, PlanTrigger::kTrack, "track " + std::to_string(id));

  for (const Report& report : v.reports) {
    if (now - report.newest <= from_seconds(settings_.report_life_s))
      add(report.disc, PlanTrigger::kVehicleBlocked, "the reported block");
  }

  const VehicleEntry* blocker = nullptr;
  double blocker_m = kNearBlock_m;
  const bool asks = is_blocked_on_its_plan(v, now) && v.navigation->reason == Reason::kVehicle;

  for (const auto& [id, other] : vehicles_) {
    if (&other == &v || !other.pose.seen() || !other.radius_m) continue;
    const Point2 there = other.pose.any()->position();

    if (is_parked(other, now)) {
      add({there, other.shape.reach_m}, PlanTrigger::kTrack, id);
    } else if (asks && geometry::distance(there, v.navigation->blocked_at_in_map) < blocker_m) {
      blocker = &other;
      blocker_m = geometry::distance(there, v.navigation->blocked_at_in_map);
    }
  }

  if (blocker != nullptr)
    add({blocker->pose.any()->position(), blocker->shape.reach_m}, PlanTrigger::kVehicleBlocked, blocker->id);

  return obstacles;
}

// Looks along what remains of the plan, at the middle of each sample.
const FleetPlanner::Obstacle* FleetPlanner::first_on_the_way(const VehicleEntry& v,
                                                             const std::vector<Obstacle>& obstacles) const {
  if (obstacles.empty()) return nullptr;

  const std::vector<Point2> rest = v.progress.remaining();
  const Point2 here = v.pose.any()->position();
  const Point2 goal = v.goal->pose_in_map.position();
  double along_m = 0.0;

  for (std::size_t i = 1; i < rest.size(); ++i) {
    const double length_m = geometry::distance(rest[i - 1], rest[i]);
    const int pieces = 1 + static_cast<int>(length_m / kSample_m);

    for (int k = 0; k < pieces; ++k, along_m += length_m / pieces) {
      if (along_m > settings_.look_ahead_m) return nullptr;
      const Point2 p = rest[i - 1] + ((k + 0.5) / pieces) * (rest[i] - rest[i - 1]);

      // Half the margin makes the difference between a plan that is left alone and one that is made anew; at tight ends
      // there is none.
      const bool is_near_end =
          std::min(geometry::distance(p, here), geometry::distance(p, goal)) <= settings_.tight_range_m;
      const double beside_m = *v.radius_m + (is_near_end ? -kSmallest_m : 0.5 * settings_.margin_m);

      for (const Obstacle& obstacle : obstacles) {
        if (geometry::distance(p, obstacle.disc.center_in_map) < obstacle.disc.radius_m + beside_m) return &obstacle;
      }
    }
  }

  return nullptr;
}

}  // namespace aisle::global_planner
