#include <algorithm>
#include <cmath>
#include <utility>

#include "services/global-planner/core/traffic/coordinator.hpp"

namespace aisle::global_planner::traffic {
namespace {

using geometry::Point2;

constexpr double kBrakeShare = 0.7;     // of the deceleration, that a body off its road is counted to stop with
constexpr double kBeyondTubeM = 0.02;   // so much farther off its path a body is off its road
constexpr double kBeyondLimitM = 0.05;  // the same at the end of its road
constexpr double kAskAgainS = 1.0;      // between two questions for road, while the body is off its own
constexpr double kStandsMps = 0.02;
constexpr double kPlannedAnewS = 2.0;  // a vehicle that has stood off its road for so long is planned for anew

/// The shape with all its capsules wider.
Shape wider(const Shape& shape, double by_m) {
  std::vector<Capsule> capsules = shape.capsules();
  for (Capsule& capsule : capsules) capsule.radius_m += by_m;
  return Shape(std::move(capsules));
}

}  // namespace

/// By its own word it is off its path; or it has driven all its road, and is not at the end of it.
bool Coordinator::is_off_road(const VehicleEntry& vehicle) const {
  if (vehicle.said.stray_m > vehicle.kind.tube_m + kBeyondTubeM) return true;

  const Agent& agent = plans_.agents().at(vehicle.id);
  const bool has_driven_all = agent.pending() == 0 && vehicle.lead_in.path_in_map.empty();
  const Point2 end = roadmap_.place(agent.place).base_in_map.position();
  return has_driven_all &&
         geometry::distance(end, vehicle.said.base_in_map.position()) > vehicle.kind.tube_m + kBeyondLimitM;
}

/// What a vehicle may fill off its road is held as it is, whatever it meets, until it is back. Alone it has no road
/// that it must keep to.
void Coordinator::look_for_strays(double now_s) {
  if (is_alone()) return;

  for (auto& [id, vehicle] : vehicles_) {
    if (!vehicle.is_registered || vehicle.is_silent) continue;

    const bool was_off_road = std::exchange(vehicle.is_off_road, is_off_road(vehicle));
    if (vehicle.is_off_road) {
      if (!was_off_road) {
        vehicle.off_road_s = now_s;
        events_.push_back(id + " is off its road: its body is held where it is");
      }

      hold_body(vehicle, now_s);
    } else if (was_off_road) {
      lock_.force(id, floor_of_lead_in(vehicle));
      events_.push_back(id + " is back on its road");
    }
  }
}

/// The body, grown by the way that it takes to stop. Road of others that meets it is asked back. A vehicle that has
/// stood there for a while gives its own road back, and is planned for from where it is.
void Coordinator::hold_body(VehicleEntry& vehicle, double now_s) {
  const double v = vehicle.said.speed_mps;
  const double stops_in_m =
      v * v / (2.0 * kBrakeShare * vehicle.kind.limits.max_deceleration_mps2) + v * settings_.latency_s;

  Shape body = wider(standing_shape(vehicle.kind, vehicle.said.base_in_map), stops_in_m);
  body.add(floor_of_lead_in(vehicle));
  body = roadmap_.zones().held(std::move(body));
  lock_.force(vehicle.id, body);
  if (now_s >= vehicle.asked_around_s + kAskAgainS) {
    vehicle.asked_around_s = now_s;
    ask_back_around(vehicle, body, now_s);
  }

  if (v >= kStandsMps) {
    vehicle.off_road_s = now_s;
  } else if (now_s >= vehicle.off_road_s + kPlannedAnewS && now_s >= vehicle.asked_back_s + kAskAgainS) {
    const Agent* agent = plans_.find(vehicle.id);
    if (agent->pending() > 0) {
      ask_back(vehicle, agent->done, now_s);
    } else if (vehicle.lead_in.path_in_map.empty()) {
      rebase(vehicle, now_s);
    }
  }
}

/// The floor of its lead-in, which is forced as long as it has one.
Shape Coordinator::floor_of_lead_in(const VehicleEntry& vehicle) const {
  if (vehicle.lead_in.path_in_map.empty()) return {};
  return roadmap_.zones().held(swept_shape(vehicle.kind, vehicle.lead_in.path_in_map, vehicle.lead_in.headings_rad));
}

/// It had no tube while it was alone. Until it names a plan with one it may be beside its road; once it stands at the
/// end of its road, its word says where.
bool Coordinator::may_be_wide(const VehicleEntry& vehicle) const {
  if (vehicle.newest_wide_plan == 0 || vehicle.said.plan_id > vehicle.newest_wide_plan) return false;

  if (!vehicle.is_registered) return false;

  const bool has_road = plans_.agents().at(vehicle.id).pending() > 0 || !vehicle.lead_in.path_in_map.empty();
  return has_road || vehicle.said.speed_mps >= kStandsMps;
}

/// A vehicle that may be wide beside others; empty: there is none.
std::string Coordinator::wide_one() const {
  if (is_alone()) return {};

  const auto found = std::find_if(vehicles_.begin(), vehicles_.end(),
                                  [&](const auto& vehicle) { return may_be_wide(vehicle.second); });
  return found == vehicles_.end() ? std::string() : found->first;
}

}  // namespace aisle::global_planner::traffic
