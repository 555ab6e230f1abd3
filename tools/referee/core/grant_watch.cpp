#include "tools/referee/core/grant_watch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <limits>

namespace aisle::referee {
namespace {

constexpr double kClearlyM = 0.05;
constexpr std::size_t kMostPlans = 16;  // that a vehicle may still drive by

}  // namespace

void GrantWatch::plan_arrived(const std::string& agv_id, std::uint64_t plan_id,
                              const std::vector<geometry::Point2>& waypoints_in_map, bool has_steps) {
  Followed& vehicle = vehicles_[agv_id];
  GrantedPlan& plan = vehicle.plans[plan_id];
  plan.waypoints_in_map = waypoints_in_map;
  plan.has_steps = has_steps;

  while (vehicle.plans.size() > kMostPlans) vehicle.plans.erase(vehicle.plans.begin());
}

void GrantWatch::grant_arrived(const std::string& agv_id, std::uint64_t plan_id, double limit_m) {
  GrantedPlan& plan = vehicles_[agv_id].plans[plan_id];
  plan.is_granted = true;
  plan.limit_m = std::max(plan.limit_m, limit_m);
}

void GrantWatch::vehicle_reported(const VehicleReport& report) {
  Followed& vehicle = vehicles_[report.agv_id];
  vehicle.plan_id = report.command_plan_id;
}

void GrantWatch::vehicle_seen(const std::string& agv_id, geometry::Point2 base_in_map, double t_s) {
  const auto known = vehicles_.find(agv_id);
  if (known == vehicles_.end()) return;

  Followed& vehicle = known->second;
  const auto found = vehicle.plans.find(vehicle.plan_id);
  bool is_beyond = false;
  double along_m = 0.0;

  if (found != vehicle.plans.end() && found->second.has_steps && found->second.waypoints_in_map.size() > 1) {
    GrantedPlan& plan = found->second;
    along_m = advance(plan, base_in_map);
    is_beyond = plan.is_granted && along_m > plan.limit_m + kSlackM;
  }

  if (!is_beyond) {
    vehicle.beyond_since_s = -1.0;
    vehicle.is_told = false;
    return;
  }

  if (vehicle.beyond_since_s < 0.0) vehicle.beyond_since_s = t_s;
  if (vehicle.is_told || t_s - vehicle.beyond_since_s < kGraceS) return;

  vehicle.is_told = true;
  violations_.push_back({AuthorityViolation::Kind::kBeyondGrant, agv_id, vehicle.beyond_since_s,
                         fmt::format("is {:.2f} m along plan {}, of which {:.2f} m were granted", along_m,
                                     vehicle.plan_id, found->second.limit_m)});
}

/// Progress never falls. Where the way passes one place twice, the vehicle is on the part that was granted, as long as
/// it is beside that part and not beyond its end.
double GrantWatch::advance(GrantedPlan& plan, geometry::Point2 base_in_map) {
  const double most_m = plan.along_m + (plan.is_begun ? kAheadM : kFirstM);
  const double granted_m = plan.is_granted ? std::max(plan.limit_m + kSlackM, plan.along_m) : most_m;
  plan.is_begun = true;

  const Spot granted = nearest(plan, base_in_map, std::min(granted_m, most_m));
  const bool is_beside_it = granted.beside_m < kTubeM && granted.along_m < granted_m;

  plan.along_m = is_beside_it ? granted.along_m : nearest(plan, base_in_map, most_m).along_m;
  return plan.along_m;
}

/// Of parts that are about equally near, the earliest.
GrantWatch::Spot GrantWatch::nearest(const GrantedPlan& plan, geometry::Point2 base_in_map, double most_m) {
  const std::vector<geometry::Point2>& way = plan.waypoints_in_map;
  Spot best{plan.along_m, std::numeric_limits<double>::infinity()};
  double begin_m = 0.0;

  for (std::size_t i = 1; i < way.size() && begin_m <= most_m; ++i) {
    const geometry::Point2 leg = way[i] - way[i - 1];
    const double length_m = geometry::norm(leg);
    const double low_m = std::max(plan.along_m - begin_m, 0.0), high_m = std::min(most_m - begin_m, length_m);

    if (length_m > 0.0 && low_m <= high_m) {
      const geometry::Point2 from = base_in_map - way[i - 1];
      const double on_leg_m = std::clamp((from.x * leg.x + from.y * leg.y) / length_m, low_m, high_m);
      const double beside_m = geometry::distance(base_in_map, way[i - 1] + (on_leg_m / length_m) * leg);

      if (beside_m < best.beside_m - kClearlyM) best = {begin_m + on_leg_m, beside_m};
    }

    begin_m += length_m;
  }

  return best;
}

}  // namespace aisle::referee
