#include <algorithm>

#include "services/global-planner/core/traffic/coordinator.hpp"
#include "services/global-planner/core/traffic/space_time_search.hpp"

namespace aisle::global_planner::traffic {
namespace {

constexpr double kBlockedAfterS = 2.0;  // a vehicle that stands so long before something has it closed
constexpr double kBlockLastsS = 30.0;   // after the last word of it: then a vehicle may look again
constexpr double kBesideThingM = 0.05;
constexpr double kAskAgainS = 1.0;  // between two questions for road, while the vehicle drives
constexpr double kStandsMps = 0.02;

}  // namespace

void Coordinator::set_standing(const std::string& name, const Shape& shape, double now_s) {
  if (shape.empty()) {
    open("standing " + name);
  } else {
    close("standing " + name, shape, now_s);
  }
}

void Coordinator::close(const std::string& name, const Shape& shape, double) {
  roadmap_.close(name, shape);
  has_changed_ = true;
  plans_changed();
}

void Coordinator::open(const std::string& name) {
  roadmap_.open(name);
  plans_changed();
}

/// Nobody enters closed floor; whoever is inside may leave.
bool Coordinator::is_open(MotionId id) const {
  const Motion& motion = roadmap_.motion(id);
  return SpaceTimeSearch::may_drive(motion, roadmap_.place(motion.from), roadmap_.place(motion.to));
}

/// Plans that lead over closed floor are cut before it; what is granted there is asked back.
void Coordinator::leave_closed_floor(double now_s) {
  has_changed_ = false;

  for (auto& [id, vehicle] : vehicles_) {
    const Agent* agent = plans_.find(id);
    if (agent == nullptr || agent->is_frozen) continue;

    const std::size_t granted = agent->pending();
    bool is_granted_floor_closed = false;

    for (std::size_t i = 0; i < agent->steps.size(); ++i) {
      if (is_open(agent->steps[i].motion)) continue;

      if (i < granted) {
        if (!is_granted_floor_closed && vehicle.closed_since_s < 0.0) vehicle.closed_since_s = now_s;
        is_granted_floor_closed = true;

        if (!may_ask_back(vehicle, roadmap_.motion(agent->steps[i].motion), now_s) ||
            (is_alone() && !has_way_round(vehicle, now_s))) {
          has_changed_ = true;  // looked at again
          continue;
        }
      }

      // The step that it is in leads out of closed floor, or is driven to its end; the vehicle looks by itself.
      // A vehicle alone gives back all that it can: its next way leads round from farther away.
      if (i < granted && i > 0) ask_back(vehicle, agent->done + (is_alone() ? 1 : i), now_s);

      plans_.cut(id, now_s);
      plans_.find(id)->has_plan_to_goal = false;
      vehicle.tried_s = -1e9;
      break;
    }

    if (!is_granted_floor_closed) vehicle.closed_since_s = -1.0;
  }
}

/// A thing that stands on granted floor may go on soon, and the vehicle sees it: its road is asked back after a while.
/// A vehicle that drives and could not give back what was asked for is not asked again at once.
bool Coordinator::may_ask_back(const VehicleEntry& vehicle, const Motion& motion, double now_s) const {
  if (motion.is_blocked && now_s < vehicle.closed_since_s + kBlockedAfterS) return false;
  return vehicle.said.speed_mps < kStandsMps || now_s >= vehicle.asked_back_s + kAskAgainS;
}

/// Is there another way to its goal from where the step that it is in ends? Without one, a vehicle alone drives on to
/// what stands there, and says so when it has to stop. Looked for once a second at most; in between: no.
bool Coordinator::has_way_round(VehicleEntry& vehicle, double now_s) {
  if (!own_way_ || !vehicle.goal_in_map || !vehicle.kind.turns_on_the_spot()) return true;
  if (now_s < vehicle.own_tried_s + kAskAgainS) return false;

  vehicle.own_tried_s = now_s;
  const Motion& motion = roadmap_.motion(plans_.find(vehicle.id)->steps.front().motion);
  return !own_way_(vehicle.id, motion.path_in_map.back(), vehicle.goal_in_map->position()).empty();
}

/// Something stands before a vehicle: after a while its floor is closed, and the vehicle gives back what it has.
void Coordinator::look_for_blocks(double now_s) {
  for (auto& [id, vehicle] : vehicles_) {
    if (!vehicle.is_registered || vehicle.is_silent) continue;

    if (!vehicle.said.is_blocked) {
      vehicle.blocked_since_s = -1.0;
    } else if (vehicle.blocked_since_s < 0.0) {
      vehicle.blocked_since_s = now_s;
    }

    const std::string name = "before " + id;
    const bool is_long = vehicle.said.is_blocked && now_s >= vehicle.blocked_since_s + kBlockedAfterS;

    if (is_long) {
      const geometry::Point2 at = vehicle.said.blocked_at_in_map;
      if (vehicle.blocked_until_s < 0.0) {
        close(name, Shape({Capsule{at, at, vehicle.said.blocked_radius_m + kBesideThingM}}), now_s);
        events_.push_back(id + " stands before something");
      }

      vehicle.blocked_until_s = now_s + kBlockLastsS;
      const Agent* agent = plans_.find(id);
      const bool has_lead_in = !vehicle.lead_in.path_in_map.empty();
      if ((has_lead_in || agent->granted > agent->done) && vehicle.said.plan_id == vehicle.way.plan_id) {
        ask_back(vehicle, has_lead_in ? vehicle.said.step_done : agent->done, now_s);
        vehicle.blocked_since_s = now_s;
      }

      continue;
    }

    if (vehicle.blocked_until_s >= 0.0 && now_s >= vehicle.blocked_until_s) {
      vehicle.blocked_until_s = -1.0;
      open(name);
    }
  }
}

void Coordinator::ask_back(VehicleEntry& vehicle, std::uint64_t limit_step, double now_s) {
  if (vehicle.asked_back && vehicle.asked_back->limit_step <= limit_step) return;

  vehicle.asked_back_s = now_s;
  vehicle.asked_back = AskedBack{limit_step, 0};
  events_.push_back(vehicle.id + " is asked for its road from step " + std::to_string(limit_step) + " on");
}

}  // namespace aisle::global_planner::traffic
