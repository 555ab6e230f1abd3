#include "tools/aisle/drive_picture.hpp"

#include <algorithm>

#include "tools/referee/core/walls.hpp"
#include "tools/referee/report/fleet_svg.hpp"

namespace aisle::cli {

using local_planner::Phase;

DrivePicture::DrivePicture(const lockstep::Setup& setup) : setup_(setup) {
  report_.scenario = setup.scenario.name;
  report_.seed = setup.seed;
  for (const scenario::Vehicle& vehicle : setup.scenario.vehicles) {
    referee::VehicleRow& row = report_.vehicles[vehicle.id];
    row.agv_id = vehicle.id;
    const geometry::Footprint footprint = vehicle.footprint();
    row.shape = footprint.is_disc() ? referee::Shape{footprint.radius_m, 0.0, 0.0} : referee::Shape{0.0, footprint.length_m, footprint.width_m};
  }
  for (const scenario::Mission& mission : setup.scenario.missions)
    for (const geometry::Pose2& goal : mission.goals_in_map) {
      referee::GoalRecord record;
      record.agv_id = mission.vehicle;
      record.goal_id = mission.vehicle + "-" + std::to_string(report_.goals.size() + 1);
      record.pose_in_map = goal;
      report_.goals.push_back(record);
    }
  report_.goals_expected = static_cast<int>(report_.goals.size());
}

lockstep::Watch DrivePicture::watch() {
  return [this](const lockstep::Snapshot& now) { look(now); };
}

void DrivePicture::look(const lockstep::Snapshot& now) {
  report_.duration_s = now.t_s;
  for (std::size_t i = 0; i < now.vehicles.size(); ++i) {
    const local_planner::Output& output = now.outputs[i];
    const geometry::Pose2 outline_in_map = geometry::body_of(setup_.scenario.vehicles[i].footprint(), now.vehicles[i]).base_in_map;
    const referee::Standing standing = output.phase == Phase::kWaiting ? referee::Standing::kWaits
                                       : output.phase == Phase::kHeld ? referee::Standing::kHolds
                                                                      : referee::Standing::kNone;
    report_.vehicles[setup_.scenario.vehicles[i].id].drive.drove(now.t_s, outline_in_map, output.twist.linear_mps, true, standing);
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

std::string DrivePicture::svg(const lockstep::Result& result) const {
  referee::RunReport report = report_;
  // Goals are reached in order, vehicle by vehicle; which one was missed the log says.
  int reached = result.goals_reached;
  for (referee::GoalRecord& goal : report.goals) goal.outcome = reached-- > 0 ? referee::GoalOutcome::kReached : referee::GoalOutcome::kFailed;
  report.ended_because = "lock-step, " + setup_.planner + " and " + setup_.local;
  return referee::fleet_svg(report, referee::Walls(setup_.grid));
}

}  // namespace aisle::cli
