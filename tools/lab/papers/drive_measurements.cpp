#include "tools/lab/papers/drive_measurements.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>
#include <future>
#include <mutex>
#include <stdexcept>

#include "common/grid/clearance.hpp"
#include "services/fake-world/core/walker.hpp"
#include "services/global-planner/core/variant.hpp"
#include "services/local-planner/core/route.hpp"
#include "tools/lab/driving/fused_drive.hpp"
#include "tools/lab/papers/plan_measurements.hpp"
#include "tools/lab/planning/paper_maps.hpp"

namespace aisle::lab {
namespace {

using geometry::Point2;
using Path = std::vector<Point2>;

constexpr double kRadiusM = 0.35;         // of the vehicle
constexpr double kPlannedRadiusM = 0.45;  // with its margin, as drive_fused plans
constexpr double kNearM = 0.6;            // a wall or box is near: between it and the outline
constexpr double kNearMoverM = 1.5;       // a mover is near
constexpr double kNearTurnM = 1.0;        // a node where the path turns sharply is near
constexpr double kSharpTurnRad = 0.35;    // 20 degrees, within kSharpWithinM
constexpr double kSharpWithinM = 0.3;
constexpr double kMovingMps = 0.02;
constexpr double kBlindStepS = 0.05;

double turned_between(Point2 a, Point2 b, Point2 c) {
  return std::abs(std::atan2(geometry::cross(b - a, c - b), geometry::dot(b - a, c - b)));
}

/// Counts turns that are sharper than kSharpTurnRad from one piece of kSharpWithinM to the next; consecutive ones are
/// one turn. Plans and driven ways are sampled alike, along their length.
int sharp_turns_of_way(const Path& way) {
  const Path points = local_planner::resample(way, kSharpWithinM);
  int turns = 0;
  bool was_sharp = false;
  for (std::size_t i = 2; i < points.size(); ++i) {
    const bool is_sharp = turned_between(points[i - 2], points[i - 1], points[i]) > kSharpTurnRad;
    turns += is_sharp && !was_sharp ? 1 : 0;
    was_sharp = is_sharp;
  }
  return turns;
}

/// The nodes where the path turns sharply.
Path sharp_nodes(const Path& path) {
  Path nodes;
  for (std::size_t i = 2; i < path.size(); ++i)
    if (turned_between(path[i - 2], path[i - 1], path[i]) > kSharpTurnRad) nodes.push_back(path[i - 1]);
  return nodes;
}

double distance_to_path(Point2 point, const Path& path) {
  double least = 1e9;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Point2 along = path[i] - path[i - 1];
    const double squared = geometry::dot(along, along);
    const double share =
        squared > 0.0 ? std::clamp(geometry::dot(point - path[i - 1], along) / squared, 0.0, 1.0) : 0.0;
    least = std::min(least, geometry::distance(point, path[i - 1] + share * along));
  }
  return least;
}

Path planned(const DrawnMap& map, const std::string& planner, double radius_m) {
  const grid::ClearanceField clearance(map.grid, 10.0);
  global_planner::Problem problem{clearance, map.start_in_map, map.goal_in_map, radius_m};
  problem.safe_distance_m = radius_m + kPapersSafeDistanceM;
  return plan_contestant(planner)->plan(problem, nullptr).waypoints_in_map;
}

DriveOutcome outcome_of_path(const Path& path) {
  DriveOutcome outcome;
  outcome.arrived = !path.empty();
  outcome.met_what_is_there = true;  // a path meets nothing and is left out for nothing
  outcome.figures[DriveFigure::kLength] = global_planner::path_length_m(path);
  outcome.figures[DriveFigure::kSharpTurns] = sharp_turns_of_way(path);
  return outcome;
}

/// The vehicle follows the path at a constant speed and stops for nothing; only whether it touches something is found.
DriveOutcome outcome_of_blind_drive(const Path& path, const Encounters& encounters, double speed_mps) {
  DriveOutcome outcome = outcome_of_path(path);
  if (path.empty()) return outcome;

  const local_planner::Route way(path);
  std::vector<fake_world::Walker> walkers;
  for (const scenario::Mover& mover : encounters.movers) walkers.emplace_back(mover, fake_world::Walker::Progress{});
  for (double t_s = 0.0; t_s * speed_mps < way.length_m() && !outcome.touched; t_s += kBlindStepS) {
    const Point2 here = way.at(t_s * speed_mps);
    for (fake_world::Walker& walker : walkers) {
      const scenario::Mover& mover = walker.mover();
      outcome.touched |= geometry::distance(here, walker.motion().position_in_map) < kRadiusM + mover.radius_m;
      if (t_s >= mover.start_s) walker.step(kBlindStepS, {});
    }
    for (const scenario::Block& box : encounters.boxes) {
      const Point2 middle = box.center_in_map.position();
      const double across_m = std::max(0.0, std::abs(here.x - middle.x) - 0.5 * box.length_m);
      const double along_m = std::max(0.0, std::abs(here.y - middle.y) - 0.5 * box.width_m);
      outcome.touched |= std::hypot(across_m, along_m) < kRadiusM;
    }
  }
  outcome.figures[DriveFigure::kTouches] = outcome.touched ? 1.0 : 0.0;
  return outcome;
}

/// Means near movers and elsewhere, only when there was both.
void add_near_movers(const DriveFigures& drive, DriveOutcome& outcome) {
  double near_mps = 0.0, near_radps = 0.0, near = 0.0, elsewhere = 0.0;
  for (const DrivePoint& point : drive.points) {
    const bool is_near = point.mover_gap_m < kNearMoverM;
    (is_near ? near : elsewhere) += 1.0;
    (is_near ? near_mps : outcome.elsewhere_mps) += point.linear_mps;
    (is_near ? near_radps : outcome.elsewhere_radps) += std::abs(point.angular_radps);
  }
  if (near == 0.0 || elsewhere == 0.0) return;
  outcome.figures[DriveFigure::kSpeedNearMover] = near_mps / near;
  outcome.figures[DriveFigure::kTurnNearMover] = near_radps / near;
  outcome.elsewhere_mps /= elsewhere;
  outcome.elsewhere_radps /= elsewhere;
}

/// The mean speed near sharp turns of the path, only when there was a moment near one.
void add_near_turns(const DriveFigures& drive, const Path& path, DriveOutcome& outcome) {
  const Path nodes = sharp_nodes(path);
  double sum_mps = 0.0, near = 0.0;
  for (const DrivePoint& point : drive.points) {
    const Point2 here = point.base_in_map.position();
    const bool is_near = std::any_of(nodes.begin(), nodes.end(),
                                     [&](Point2 node) { return geometry::distance(here, node) < kNearTurnM; });
    if (is_near) sum_mps += point.linear_mps, near += 1.0;
  }
  if (near > 0.0) outcome.figures[DriveFigure::kSpeedNearTurn] = sum_mps / near;
}

DriveOutcome outcome_of(const DriveFigures& drive, const Path& path, const Surprises& surprises) {
  DriveOutcome outcome;
  outcome.arrived = drive.arrived();
  outcome.touched = drive.result.contacts_moving_vehicle > 0;
  outcome.met_what_is_there = drive.met(surprises);
  Path way;
  double low_radps = 0.0, high_radps = 0.0, off_m = 0.0, near = 0.0;
  for (const DrivePoint& point : drive.points) {
    if (point.linear_mps > kMovingMps || way.empty()) way.push_back(point.base_in_map.position());
    low_radps = std::min(low_radps, point.angular_radps);
    high_radps = std::max(high_radps, point.angular_radps);
    off_m += distance_to_path(point.base_in_map.position(), path);
    near += point.gap_m < kNearM ? 1.0 : 0.0;
  }
  auto& figures = outcome.figures;
  figures[DriveFigure::kLength] = drive.result.distance_m;
  figures[DriveFigure::kTime] = drive.result.driven_s;
  figures[DriveFigure::kSharpTurns] = sharp_turns_of_way(way);
  figures[DriveFigure::kChangesOfV] = drive.changes_of_v();
  figures[DriveFigure::kChangesOfW] = drive.changes_of_w();
  figures[DriveFigure::kTouches] = outcome.touched ? 1.0 : 0.0;
  figures[DriveFigure::kRangeOfW] = high_radps - low_radps;
  figures[DriveFigure::kDistanceToPath] = off_m / std::max<double>(1.0, static_cast<double>(drive.points.size()));
  if (near > 0.0) figures[DriveFigure::kSpeedNear] = drive.mean_speed_near(kNearM);
  add_near_turns(drive, path, outcome);
  add_near_movers(drive, outcome);
  return outcome;
}

constexpr const char* kByCriticsAlone = "-by-critics";

/// The drive of a contestant, without its map.
FusedDrive drive_of(const DriveScene& scene, std::string contestant) {
  FusedDrive drive;
  const std::size_t suffix = contestant.rfind(kByCriticsAlone);
  drive.slows_on_the_way = suffix == std::string::npos;
  contestant = contestant.substr(0, suffix);
  drive.limits = paper_variant(scene.paper).paper;
  drive.surprises = scene.surprises;
  drive.global = contestant == "astar" || contestant == "astar-own" ? "astar" : scene.paper;
  drive.local = contestant == "dwa"                                     ? traditional_alone()
                : contestant == "dwa-own"                               ? paper_critics_alone(scene.paper)
                : contestant == "improved" || contestant == "astar-own" ? paper_variant(scene.paper)
                                                                        : traditional_with_path();
  return drive;
}

DriveOutcome outcome_on(const DrawnMap& map, const DriveScene& scene, const std::string& contestant) {
  if (contestant == "improved-plan") return outcome_of_path(planned(map, scene.paper, kPlannedRadiusM));
  if (contestant == "traditional-plan") return outcome_of_path(planned(map, "traditional", 0.0));

  const FusedDrive drive = drive_of(scene, contestant);
  const Encounters encounters = encounters_on(map, scene.surprises, drive.limits.max_speed_mps);
  const Path path = planned(map, drive.global, kPlannedRadiusM);
  if (contestant == "improved-blind")
    return outcome_of_blind_drive(path, encounters, nominal_speed_mps(drive.limits.max_speed_mps));
  return outcome_of(drive_fused(drive, map, encounters), path, scene.surprises);
}

/// Calls `work` with 0 to count - 1, from so many threads at once. @throws what `work` throws, after all have ended
void on_threads(int threads, int count, const std::function<void(int)>& work) {
  std::atomic<int> next{0};
  const auto take = [&] {
    for (int i = next++; i < count; i = next++) work(i);
  };
  std::vector<std::future<void>> others;
  for (int i = 1; i < std::min(threads, count); ++i) others.push_back(std::async(std::launch::async, take));
  take();
  for (std::future<void>& other : others) other.get();
}

}  // namespace

const std::vector<DriveScene>& drive_scenes() {
  static const std::vector<DriveScene> all{{"li-iv", "li-complex", "li", {1, 2}},
                                           {"wu-9-11", "wu", "wu", {0, 1}},
                                           {"wu-mover", "wu", "wu", {1, 0}},
                                           {"qu-1-one", "qu-simple", "qu", {1, 0}},
                                           {"qu-1-two", "qu-simple", "qu", {2, 0}},
                                           {"qu-2-one", "qu-maze", "qu", {1, 0}},
                                           {"qu-2-two", "qu-maze", "qu", {2, 0}},
                                           {"yu-5", "yu-1", "yu", {0, 1}},
                                           {"yu-6", "yu-1", "yu", {1, 1}},
                                           {"wang-2", "wang-1", "wang", {0, 0}},
                                           {"wang-map-1", "wang-map-1", "wang", {1, 1}},
                                           {"wang-map-2", "wang-map-2", "wang", {1, 1}},
                                           {"wang-map-3", "wang-map-3", "wang", {1, 2}}};
  return all;
}

const DriveScene& scene_named(const std::string& name) {
  for (const DriveScene& scene : drive_scenes())
    if (name == scene.name) return scene;
  throw std::logic_error("no scene " + name);
}

DriveMeasurements::DriveMeasurements(const DriveDraw& draw, Progress progress)
    : draw_(draw), progress_(std::move(progress)) {}

const std::vector<DriveOutcome>& DriveMeasurements::of(const std::string& scene, const std::string& contestant) {
  const auto key = std::pair(scene, contestant);
  const auto found = measured_.find(key);
  if (found != measured_.end()) return found->second;
  return measured_[key] = measure(scene_named(scene), contestant);
}

std::vector<DriveOutcome> DriveMeasurements::measure(const DriveScene& scene, const std::string& contestant) {
  const PaperMapKind& kind = *find_paper_map_kind(scene.map);
  std::vector<DriveOutcome> outcomes(static_cast<std::size_t>(draw_.drives));
  std::mutex telling;
  int done = 0;
  on_threads(draw_.threads, draw_.drives, [&](int i) {
    const DrawnMap map = paper_map(kind, draw_.first() + static_cast<unsigned>(i));
    outcomes[static_cast<std::size_t>(i)] = outcome_on(map, scene, contestant);
    const std::lock_guard lock(telling);
    progress_("driving " + std::string(scene.name) + ", " + contestant + ": " + std::to_string(++done) + " of " +
              std::to_string(draw_.drives));
  });
  return outcomes;
}

}  // namespace aisle::lab
