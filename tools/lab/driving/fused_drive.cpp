#include "tools/lab/driving/fused_drive.hpp"

#include <algorithm>
#include <cmath>

#include "common/grid/clearance.hpp"
#include "tools/lab/planning/drawn_map.hpp"
#include "tools/sim/site.hpp"

namespace aisle::lab {
namespace {

using geometry::Point2;

constexpr double kRadiusM = 0.35;
constexpr double kLongestDriveS = 200.0;
constexpr double kDrivesMps = 0.05;  // and faster
constexpr double kStartUpS = 1.0;    // a site gives its goals sooner

sim::Setup setup_of(const FusedDrive& drive, const DrawnMap& map, const Encounters& encounters) {
  sim::Setup setup;
  setup.grid = map.grid;
  setup.planner = drive.global;
  setup.own_variant = drive.local;
  setup.own_variant->paper = drive.limits;
  setup.paper_limits = true;
  setup.settings.slows_on_the_way = drive.slows_on_the_way;

  scenario::Vehicle vehicle;
  vehicle.id = "agv-1";
  vehicle.radius_m = kRadiusM;
  vehicle.start_in_map = {map.start_in_map.x, map.start_in_map.y, 0.0};
  setup.scenario.vehicles.push_back(vehicle);
  scenario::Mission mission;
  mission.vehicle = vehicle.id;
  mission.goals_in_map = {{map.goal_in_map.x, map.goal_in_map.y, 0.0}};
  setup.scenario.missions.push_back(mission);
  setup.scenario.duration_s = kStartUpS + kLongestDriveS;
  add(encounters, setup.scenario);
  return setup;
}

/// Where the vehicle is and what it was told to do; `clearance` is that of the walls.
DrivePoint point_of(const sim::Snapshot& now, const grid::ClearanceField& clearance) {
  const geometry::Twist2& command = now.outputs[0].twist;
  DrivePoint point{now.t_s, now.vehicles_in_map[0], command.linear_mps, command.angular_radps};
  const Point2 here = point.base_in_map.position();
  point.gap_m = clearance.clearance_m(here) - kRadiusM;
  for (const geometry::Body& thing : now.things) {
    const bool is_mover = thing.shape == geometry::Body::Shape::kDisc;
    double& gap_m = is_mover ? point.mover_gap_m : point.box_gap_m;
    gap_m = std::min(gap_m, geometry::distance_m(thing, here) - kRadiusM);
  }
  point.gap_m = std::min(point.gap_m, point.box_gap_m);
  return point;
}

/// Those from the goal being given to its end, with the time since it was given.
std::vector<DrivePoint> driven(const std::vector<DrivePoint>& points, const sim::Result& result) {
  std::vector<DrivePoint> kept;
  for (DrivePoint point : points) {
    point.t_s -= result.first_goal_s;
    if (0.0 <= point.t_s && point.t_s <= result.driven_s) kept.push_back(point);
  }
  return kept;
}

double sum_of_changes(const std::vector<DrivePoint>& points, double DrivePoint::*of) {
  double sum = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i) sum += std::abs(points[i].*of - points[i - 1].*of);
  return sum;
}

}  // namespace

double DriveFigures::changes_of_v() const { return sum_of_changes(points, &DrivePoint::linear_mps); }
double DriveFigures::changes_of_w() const { return sum_of_changes(points, &DrivePoint::angular_radps); }

double DriveFigures::greatest_change_of_w() const {
  double most = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i)
    most = std::max(most, std::abs(points[i].angular_radps - points[i - 1].angular_radps));
  return most;
}

double DriveFigures::nearest_m(double DrivePoint::*gap_m) const {
  double least_m = 1e9;
  for (const DrivePoint& p : points)
    if (std::abs(p.linear_mps) > kDrivesMps) least_m = std::min(least_m, p.*gap_m);
  return least_m;
}

bool DriveFigures::met(const Surprises& asked) const {
  if (!asked.any()) return true;
  const bool has_movers = !encounters.movers.empty(), has_boxes = !encounters.boxes.empty();
  return (has_movers || has_boxes) && (!has_movers || met_a_mover()) && (!has_boxes || met_a_box());
}

double DriveFigures::mean_speed_near(double gap_m) const {
  double sum = 0.0;
  int count = 0;
  for (const DrivePoint& p : points)
    if (p.gap_m < gap_m) sum += p.linear_mps, ++count;
  return count > 0 ? sum / count : 0.0;
}

local_planner::Variant traditional_with_path() {
  local_planner::Variant variant = paper_variant("dwa");
  variant.knows_path = true;
  return variant;
}

local_planner::Variant traditional_alone() { return paper_variant("dwa"); }

local_planner::Variant paper_variant(const std::string& name) { return *local_planner::find_variant(name); }

local_planner::Variant paper_critics_alone(const std::string& name) {
  local_planner::Variant variant = paper_variant(name);
  variant.knows_path = false;
  return variant;
}

DriveFigures drive_fused(const FusedDrive& drive, const std::filesystem::path& maps) {
  const DrawnMap map = read_drawn_map(maps / (drive.map + ".txt"), 1.0);
  return drive_fused(drive, map, encounters_of_paper(drive.map, map, drive.surprises, drive.limits.max_speed_mps));
}

DriveFigures drive_fused(const FusedDrive& drive, const DrawnMap& map, const Encounters& encounters) {
  const sim::Setup setup = setup_of(drive, map, encounters);
  const grid::ClearanceField clearance(map.grid, 4.0);

  std::vector<DrivePoint> points;
  sim::Hooks hooks;
  hooks.watch = [&](const sim::Snapshot& now) { points.push_back(point_of(now, clearance)); };
  const sim::Outcome outcome = sim::drive(setup, {}, hooks);

  DriveFigures figures;
  figures.result = outcome.result;
  figures.points = driven(points, outcome.result);
  figures.movers = static_cast<int>(encounters.movers.size());
  figures.encounters = encounters;
  return figures;
}

}  // namespace aisle::lab
