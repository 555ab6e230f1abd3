#include "tools/lab/driving/fused_drive.hpp"

#include <algorithm>
#include <cmath>

#include "common/grid/clearance.hpp"
#include "services/global-planner/core/variant.hpp"
#include "services/local-planner/core/route.hpp"
#include "tools/lab/planning/drawn_map.hpp"
#include "tools/sim/site.hpp"

namespace aisle::lab {
namespace {

using geometry::Point2;
using local_planner::Route;

constexpr double kRadiusM = 0.35;
constexpr double kMoverMps = 0.5;
constexpr double kMoverWayM = 1.4;  // to each side of the planned way
constexpr double kBoxM = 0.5;
constexpr double kLongestDriveS = 200.0;
constexpr double kStartUpS = 1.0;  // a site gives its goals sooner

Route planned(const FusedDrive& drive, const DrawnMap& map, const grid::ClearanceField& clearance) {
  global_planner::Problem problem{clearance, map.start_in_map, map.goal_in_map};
  problem.radius_m = kRadiusM + 0.1;
  return Route(
      global_planner::find_variant(drive.global)->make()->plan(problem, [] { return false; }).waypoints_in_map);
}

/// The places along the way, away from its ends, with this much room around them; nearest to `share` of it first.
std::vector<double> roomy_places_m(const Route& way, const grid::ClearanceField& clearance, double room_m,
                                   double share) {
  std::vector<double> places;
  for (double s = 3.0; s < way.length_m() - 3.0; s += 0.25)
    if (clearance.clearance_m(way.at(s)) >= room_m) places.push_back(s);
  std::sort(places.begin(), places.end(), [&](double a, double b) {
    return std::abs(a - share * way.length_m()) < std::abs(b - share * way.length_m());
  });
  return places;
}

/// Walks across the way, so that it is there when a vehicle at two thirds of its speed would be.
void add_crosser(scenario::Scenario& scenario, const Route& way, double s_m, double speed_mps) {
  const double yaw = way.heading_at(s_m);
  const Point2 aside = kMoverWayM * Point2{-std::sin(yaw), std::cos(yaw)};
  scenario::Mover mover;
  mover.id = "mover-" + std::to_string(scenario.movers.size() + 1);
  mover.speed_mps = kMoverMps;
  mover.courteous = false;
  mover.loop = false;
  mover.start_s = std::max(0.0, s_m / (0.66 * speed_mps) - kMoverWayM / kMoverMps);
  mover.waypoints_in_map = {way.at(s_m) + aside, way.at(s_m) - aside};
  scenario.movers.push_back(mover);
}

void add_box(scenario::Scenario& scenario, Point2 center_in_map) {
  scenario::Block box;
  box.id = "box-" + std::to_string(scenario.blocks.size() + 1);
  box.center_in_map = {center_in_map.x, center_in_map.y, 0.0};
  box.length_m = box.width_m = kBoxM;
  scenario.blocks.push_back(box);
}

void surprise(scenario::Scenario& scenario, const FusedDrive& drive, const DrawnMap& map) {
  const grid::ClearanceField clearance(map.grid, 4.0);
  const Route way = planned(drive, map, clearance);
  for (int i = 0; i < drive.surprises.movers; ++i) {
    const auto places = roomy_places_m(way, clearance, kMoverWayM + 0.3, (i + 1.0) / (drive.surprises.movers + 1.0));
    if (!places.empty()) add_crosser(scenario, way, places.front(), drive.limits.max_speed_mps);
  }
  for (int i = 0; i < drive.surprises.hidden_boxes; ++i) {
    const auto places = roomy_places_m(way, clearance, 1.5, (i + 0.4) / (drive.surprises.hidden_boxes + 0.2));
    if (!places.empty()) add_box(scenario, way.at(places.front()));
  }
}

sim::Setup setup_of(const FusedDrive& drive, const DrawnMap& map) {
  sim::Setup setup;
  setup.grid = map.grid;
  setup.planner = drive.global;
  setup.own_variant = drive.local;
  setup.own_variant->paper = drive.limits;
  setup.paper_limits = true;
  setup.settings.lane.shift_m = 0.0;  // the papers' vehicles are alone and keep no side
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
  if (drive.surprises.any()) surprise(setup.scenario, drive, map);
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
    double& gap_m = is_mover ? point.mover_gap_m : point.gap_m;
    gap_m = std::min(gap_m, geometry::distance_m(thing, here) - kRadiusM);
  }
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

double DriveFigures::nearest_mover_m() const {
  double least_m = 1e9;
  for (const DrivePoint& p : points) least_m = std::min(least_m, p.mover_gap_m);
  return least_m;
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

DriveFigures drive_fused(const FusedDrive& drive, const std::filesystem::path& maps) {
  const DrawnMap map = read_drawn_map(maps / (drive.map + ".txt"), 1.0);
  const sim::Setup setup = setup_of(drive, map);
  const grid::ClearanceField clearance(map.grid, 4.0);

  std::vector<DrivePoint> points;
  sim::Hooks hooks;
  hooks.watch = [&](const sim::Snapshot& now) { points.push_back(point_of(now, clearance)); };
  const sim::Outcome outcome = sim::drive(setup, {}, hooks);

  DriveFigures figures;
  figures.result = outcome.result;
  figures.points = driven(points, outcome.result);
  figures.movers = static_cast<int>(setup.scenario.movers.size());
  return figures;
}

}  // namespace aisle::lab
