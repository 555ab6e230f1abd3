#include "services/local-planner/codec.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "common/wire/geometry.hpp"
#include "common/wire/vehicle.hpp"

namespace aisle::local_planner {
namespace {

using wire::Checks;
using wire::decode;
using wire::Decoded;
using wire::encode;

constexpr std::size_t kMostIntent = 64;
constexpr std::size_t kMostDetail = 256;

template <class T>
Decoded<T> checked(const Checks& checks, T value) {
  return checks.ok() ? Decoded<T>(std::move(value)) : Decoded<T>::refused(checks.reason());
}

}  // namespace

Decoded<Vehicle> decode(const aisle::VehicleInfo& sample) {
  const auto info = wire::decode(sample);
  if (!info) return Decoded<Vehicle>::refused(info.reason());
  const geometry::Footprint& footprint = info->footprint;
  return Vehicle{info->id, geometry::reach_m(footprint), info->limits,
                 footprint.is_disc() ? std::nullopt : std::optional(footprint)};
}

Decoded<StateReport> decode(const aisle::VehicleState& sample) {
  Checks checks;
  checks.id("agv_id", sample.agv_id().to_string());
  StateReport report;
  report.state = {decode(sample.base_in_map(), checks, "base_in_map"), decode(sample.twist(), checks, "twist"),
                  sample.steering_rad()};
  checks.within("steering_rad", sample.steering_rad(), -geometry::kPi, geometry::kPi);
  report.accepted_epoch = sample.accepted_epoch();
  return checked(checks, report);
}

Decoded<Plan> decode(const aisle::Plan& sample) {
  Checks checks;
  Plan plan;
  plan.id = sample.plan_id();
  plan.goal_id = sample.goal_id().to_string();
  plan.map_revision = sample.map_revision();
  plan.outcome = sample.outcome() == PlanOutcome::PLAN_FOUND       ? Plan::Outcome::kFound
                 : sample.outcome() == PlanOutcome::PLAN_CANCELLED ? Plan::Outcome::kCancelled
                                                                   : Plan::Outcome::kNotFound;
  plan.detail = sample.detail().to_string();
  plan.goal_in_map = decode(sample.goal_in_map(), checks, "goal_in_map");
  plan.position_tolerance_m = std::max(0.02, sample.position_tolerance_m());
  plan.yaw_tolerance_rad = sample.yaw_tolerance_rad();
  checks.id("agv_id", sample.agv_id().to_string())
      .known("outcome", sample.outcome(), PlanOutcome::PLAN_CANCELLED)
      .within("position_tolerance_m", sample.position_tolerance_m(), 0.0, 100.0)
      .within("yaw_tolerance_rad", sample.yaw_tolerance_rad(), 0.0, 7.0)
      .count("waypoints_in_map", sample.waypoints_in_map().size(), plan.outcome == Plan::Outcome::kFound ? 1 : 0, 4096);
  for (const aisle::Point& point : sample.waypoints_in_map())
    plan.waypoints_in_map.push_back(decode(point, checks, "waypoints_in_map"));
  return checked(checks, std::move(plan));
}

Decoded<obstacle_tracker::Track> decode(const aisle::Track& sample) {
  Checks checks;
  obstacle_tracker::Track track;
  track.id = sample.track_id();
  track.position_in_map = decode(sample.position_in_map(), checks, "position_in_map");
  track.velocity_in_map = {sample.velocity_x_mps(), sample.velocity_y_mps()};
  track.radius_m = sample.radius_m();
  track.age_s = sample.age_s();
  track.unseen_s = sample.unseen_s();
  track.is_static = sample.is_static();
  checks.within("velocity_x_mps", sample.velocity_x_mps(), -wire::kFastestMps, wire::kFastestMps)
      .within("velocity_y_mps", sample.velocity_y_mps(), -wire::kFastestMps, wire::kFastestMps)
      .within("radius_m", sample.radius_m(), 0.0, 100.0)
      .finite("age_s", sample.age_s())
      .finite("unseen_s", sample.unseen_s());
  for (std::size_t i = 0; i < track.covariance.size(); ++i) {
    track.covariance[i] = sample.covariance()[i];
    checks.finite("covariance", track.covariance[i]);
  }
  return checked(checks, track);
}

Decoded<Announcement> decode(const aisle::NavigationStatus& sample) {
  Checks checks;
  checks.id("agv_id", sample.agv_id().to_string())
      .known("phase", sample.phase(), NavigationPhase::PHASE_HELD)
      .known("reason", sample.reason(), NavigationReason::REASON_AUTHORITY)
      .count("intent", sample.intent().size(), 0, kMostIntent);
  Announcement announcement;
  announcement.phase = static_cast<Phase>(sample.phase());
  announcement.reason = static_cast<Reason>(sample.reason());
  double before_s = 0.0;
  for (const aisle::IntentPoint& point : sample.intent()) {
    checks.within("intent.offset_s", point.offset_s(), before_s, 3600.0);
    before_s = point.offset_s();
    announcement.intent.push_back({point.offset_s(), decode(point.base_in_map(), checks, "intent.base_in_map")});
  }
  return checked(checks, std::move(announcement));
}

aisle::VelocityCommand encode_command(const Output& output) {
  aisle::VelocityCommand sample;
  sample.twist(encode(output.twist));
  return sample;
}

aisle::NavigationStatus encode_status(const Output& output) {
  aisle::NavigationStatus sample;
  sample.phase(static_cast<NavigationPhase>(output.phase));
  sample.reason(static_cast<NavigationReason>(output.reason));
  sample.detail(output.detail.substr(0, kMostDetail));
  sample.distance_left_m(output.distance_left_m);
  sample.time_left_s(output.time_left_s);
  sample.blocked_at_in_map(encode(output.blocked_at_in_map));
  sample.blocked_radius_m(output.blocked_radius_m);
  for (std::size_t i = 0; i < std::min(output.intent.size(), kMostIntent); ++i) {
    aisle::IntentPoint point;
    point.offset_s(output.intent[i].offset_s);
    point.base_in_map(encode(output.intent[i].base_in_map));
    sample.intent().push_back(point);
  }
  return sample;
}

}  // namespace aisle::local_planner
