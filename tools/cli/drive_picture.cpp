#include "tools/cli/drive_picture.hpp"

#include <algorithm>
#include <cstddef>
#include <string>

#include "tools/referee/core/walls.hpp"
#include "tools/referee/report/fleet_svg.hpp"

namespace aisle::cli {

using local_planner::Phase;

namespace {

constexpr double kMovingMps = 0.06;  // what is known of a vehicle that touches: it moved, or it stood

}  // namespace

DrivePicture::DrivePicture(const lockstep::Setup& setup) : setup_(setup) {
  report_.scenario = setup.scenario.name;
  report_.seed = setup.seed;
  for (const scenario::Vehicle& vehicle : setup.scenario.vehicles) {
    referee::VehicleRow& row = report_.vehicles[vehicle.id];
    row.agv_id = vehicle.id;
    const geometry::Footprint footprint = vehicle.footprint();
    row.shape = footprint.is_disc() ? referee::Shape{footprint.radius_m, 0.0, 0.0}
                                    : referee::Shape{0.0, footprint.length_m, footprint.width_m};
  }
  report_.people_give_way = false;  // who walks into a vehicle that stands is not held against it
}

lockstep::Watch DrivePicture::watch() {
  return [this](const lockstep::Snapshot& now) { look(now); };
}

void DrivePicture::look(const lockstep::Snapshot& now) {
  report_.duration_s = now.t_s;
  for (std::size_t i = 0; i < now.vehicles.size(); ++i) {
    const local_planner::Output& output = now.outputs[i];
    const geometry::Pose2 outline_in_map =
        geometry::body_of(setup_.scenario.vehicles[i].footprint(), now.vehicles[i]).base_in_map;
    const referee::Standing standing = output.phase == Phase::kWaiting ? referee::Standing::kWaits
                                       : output.phase == Phase::kHeld  ? referee::Standing::kHolds
                                                                       : referee::Standing::kNone;
    referee::VehicleRow& row = report_.vehicles[setup_.scenario.vehicles[i].id];
    row.drive.drove(now.t_s, outline_in_map, output.twist.linear_mps, true, standing);
    if (now.plans[i] != nullptr) look_at_plan(now.t_s, *now.plans[i], row);
  }
  for (std::size_t i = 0; i < now.things.size(); ++i) {
    const geometry::Body& body = now.things[i];
    referee::BodyTrace& trace = report_.bodies["thing-" + std::to_string(i + 1)];
    const bool is_disc = body.shape == geometry::Body::Shape::kDisc;
    trace.kind = is_disc ? referee::BodyKind::kPerson : referee::BodyKind::kBlock;
    trace.shape = is_disc ? referee::Shape{body.radius_m, 0.0, 0.0} : referee::Shape{0.0, body.length_m, body.width_m};
    if (is_disc || trace.way.empty()) trace.way.emplace_back(now.t_s, body.base_in_map);
  }
}

void DrivePicture::look_at_plan(double t_s, const fleet::Plan& plan, referee::VehicleRow& row) {
  const auto before = latest_plans_.find(row.agv_id);
  if (before != latest_plans_.end() && before->second == plan.id) return;
  latest_plans_[row.agv_id] = plan.id;
  if (!plan.waypoints_in_map.empty()) row.plans.push_back({t_s, plan.waypoints_in_map});
}

/// The goals that were reached, and the one that each vehicle had then.
void DrivePicture::add_goals(const lockstep::Result& result, referee::RunReport& report) const {
  for (std::size_t i = 0; i < setup_.scenario.vehicles.size(); ++i) {
    const std::string& id = setup_.scenario.vehicles[i].id;
    int number = 0;
    for (const scenario::Mission& mission : setup_.scenario.missions) {
      const int count = static_cast<int>(mission.goals_in_map.size());
      for (int k = 0; mission.vehicle == id && k < count * mission.loops && number <= result.reached[i]; ++k) {
        referee::GoalRecord goal;
        goal.agv_id = id;
        goal.goal_id = id + "-" + std::to_string(number + 1);
        goal.pose_in_map = mission.goals_in_map[static_cast<std::size_t>(k % count)];
        goal.outcome = number++ < result.reached[i] ? referee::GoalOutcome::kReached : referee::GoalOutcome::kFailed;
        report.goals.push_back(goal);
      }
    }
  }
}

void DrivePicture::add_edits(referee::RunReport& report) const {
  for (const scenario::MapEdit& edit : setup_.scenario.map_edits) {
    if (edit.at_s > report.duration_s) continue;
    const geometry::Point2 low = edit.low_in_map, high = edit.high_in_map;
    referee::EditRow row;
    row.edit_id = "edit-" + std::to_string(report.edits.size() + 1);
    row.block = edit.block;
    row.outline_in_map = {low, {high.x, low.y}, high, {low.x, high.y}};
    row.asked_s = row.answered_s = edit.at_s;
    row.outcome = "applied";
    report.edits.push_back(row);
  }
}

void DrivePicture::add_contacts(const lockstep::Result& result, referee::RunReport& report) {
  using referee::PairClass;
  const auto pair_of = [&](const std::string& other) {
    if (other == "wall") return PairClass::kVehicleWall;
    return report.vehicles.count(other) > 0 ? PairClass::kVehicleVehicle : PairClass::kVehiclePerson;
  };
  for (const lockstep::Touch& touch : result.touches) {
    if (touch.begins)
      report.contacts.push_back(
          {pair_of(touch.other), touch.vehicle, touch.other, touch.t_s, touch.t_s, touch.at_in_map, 0.0, 0.0, 0.0});
    const auto latest = std::find_if(report.contacts.rbegin(), report.contacts.rend(), [&](const referee::Contact& c) {
      return c.a == touch.vehicle && c.b == touch.other;
    });
    if (touch.is_moving && latest != report.contacts.rend()) latest->vehicle_speed_mps = kMovingMps;
  }
}

std::string DrivePicture::svg(const lockstep::Result& result) const {
  referee::RunReport report = report_;
  report.goals_expected = result.goals_assigned;
  for (std::size_t i = 0; i < result.replanned.size(); ++i)
    report.vehicles[setup_.scenario.vehicles[i].id].replans = result.replanned[i];
  add_goals(result, report);
  add_edits(report);
  add_contacts(result, report);
  if (result.least_clearance_m < lockstep::kNothingNearM) report.clearances.least_m.front() = result.least_clearance_m;
  report.ended_because = "lock-step, " + setup_.planner + " and " + setup_.local;
  return referee::fleet_svg(report, referee::Walls(setup_.grid));
}

}  // namespace aisle::cli
