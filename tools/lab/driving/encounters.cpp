#include "tools/lab/driving/encounters.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "common/grid/clearance.hpp"
#include "services/global-planner/core/variant.hpp"
#include "services/local-planner/core/route.hpp"

namespace aisle::lab {
namespace {

using geometry::Point2;
using local_planner::Route;

constexpr double kNominalShare = 0.66;    // of the top speed
constexpr double kPlannedRadiusM = 0.45;  // of the vehicle with its margin
constexpr double kFarthestM = 4.0;        // that clearance is looked at

constexpr double kMoverMps = 0.5;
constexpr double kMoverWayM = 1.4;   // to each side of the path
constexpr double kMoverGapM = 0.05;  // that movers leave to walls
constexpr double kSweepStepM = 0.05;

constexpr double kBoxM = 0.5;
constexpr double kRoomForBoxM = 1.5;  // around its middle, where the map has it
constexpr double kLeastRoomM = 1.15;  // half the box, the vehicle's 0.7 m and 0.2 m
constexpr double kFromEndsM = 3.0;    // no surprise so near to start or goal, along the path
constexpr double kBetweenM = 2.0;     // from one to the next, along the path
constexpr double kPlacesEveryM = 0.25;
constexpr double kEqualM = 1e-6;

/// A place on the path of the plain A*, with the room that it has for what is put there.
struct Place {
  double s_m;
  double room_m;
};

class Placing {
 public:
  Placing(const DrawnMap& map, double max_speed_mps)
      : clearance_(map.grid, kFarthestM), path_(plain_path(map)), speed_mps_(nominal_speed_mps(max_speed_mps)) {}

  /// At this share of the path, or where the map has the room for it.
  void place_mover(double share) {
    const auto place =
        best(share, 2.0 * kMoverWayM, 0.0, [this](double s_m) { return sweep_m(s_m, 1.0) + sweep_m(s_m, -1.0); });
    if (place) add_mover(*place);
  }

  void place_box(double share) {
    const auto place =
        best(share, kRoomForBoxM, kLeastRoomM, [this](double s_m) { return clearance_.clearance_m(path_.at(s_m)); });
    if (place) add_box(*place);
  }

  /// A mover that the paper prints: to and fro between these two places from the beginning on.
  void place_mover(Point2 from_in_map, Point2 to_in_map) { add_mover(from_in_map, to_in_map, 0.0); }

  const Encounters& encounters() const { return placed_; }

 private:
  Route plain_path(const DrawnMap& map) const {
    global_planner::Problem problem{clearance_, map.start_in_map, map.goal_in_map};
    problem.radius_m = kPlannedRadiusM;
    return Route(global_planner::find_variant("astar")->make()->plan(problem, nullptr).waypoints_in_map);
  }

  /// How far a mover can walk from the path to its left (`side` 1) or right (-1).
  double sweep_m(double s_m, double side) const {
    const Point2 aside = side * normal_at(s_m);
    double reach_m = 0.0;
    while (reach_m < kMoverWayM - kEqualM) {
      const Point2 next = path_.at(s_m) + (reach_m + kSweepStepM) * aside;
      if (clearance_.clearance_m(next) < scenario::Mover{}.radius_m + kMoverGapM) break;
      reach_m += kSweepStepM;
    }
    return reach_m;
  }

  Point2 normal_at(double s_m) const {
    const double yaw = path_.heading_at(s_m);
    return {-std::sin(yaw), std::cos(yaw)};
  }

  bool is_taken(double s_m) const {
    return std::any_of(taken_m_.begin(), taken_m_.end(),
                       [&](double other_m) { return std::abs(other_m - s_m) < kBetweenM; });
  }

  /// The place nearest to `share` of the path that has `wanted_m` of room; where there is none the roomiest, if it has
  /// more than `least_m`.
  template <class RoomAt>
  std::optional<double> best(double share, double wanted_m, double least_m, RoomAt room_at) const {
    std::optional<Place> found;
    const auto off_m = [&](const Place& place) { return std::abs(place.s_m - share * path_.length_m()); };
    for (double s_m = kFromEndsM; s_m < path_.length_m() - kFromEndsM; s_m += kPlacesEveryM) {
      if (is_taken(s_m)) continue;
      const Place place{s_m, std::min(room_at(s_m), wanted_m)};
      const double more_m = found ? place.room_m - found->room_m : place.room_m - least_m;
      if (more_m > kEqualM || (found && more_m > -kEqualM && off_m(place) < off_m(*found))) found = place;
    }
    return found ? std::optional<double>(found->s_m) : std::nullopt;
  }

  /// It is on the path when the nominal vehicle is, and begins as early as that allows.
  void add_mover(double s_m) {
    const double left_m = sweep_m(s_m, 1.0), right_m = sweep_m(s_m, -1.0);
    const double to_and_fro_s = 2.0 * (left_m + right_m) / kMoverMps;
    const double begins_s = s_m / speed_mps_ - left_m / kMoverMps;
    add_mover(path_.at(s_m) + left_m * normal_at(s_m), path_.at(s_m) - right_m * normal_at(s_m),
              std::fmod(std::max(0.0, begins_s), to_and_fro_s));
    taken_m_.push_back(s_m);
  }

  void add_mover(Point2 from_in_map, Point2 to_in_map, double start_s) {
    scenario::Mover mover;
    mover.id = "mover-" + std::to_string(placed_.movers.size() + 1);
    mover.speed_mps = kMoverMps;
    mover.courteous = false;
    mover.loop = true;
    mover.start_s = start_s;
    mover.waypoints_in_map = {from_in_map, to_in_map};
    placed_.movers.push_back(mover);
  }

  void add_box(double s_m) {
    const Point2 center_in_map = path_.at(s_m);
    scenario::Block box;
    box.id = "box-" + std::to_string(placed_.boxes.size() + 1);
    box.center_in_map = {center_in_map.x, center_in_map.y, 0.0};
    box.length_m = box.width_m = kBoxM;
    placed_.boxes.push_back(box);
    taken_m_.push_back(s_m);
  }

  grid::ClearanceField clearance_;
  Route path_;
  double speed_mps_;
  std::vector<double> taken_m_;  // along the path
  Encounters placed_;
};

/// What a paper prints the place of.
struct PrintedMover {
  const char* map;
  Point2 from_in_map, to_in_map;
};
constexpr double kLiX = 14.0, kLiFromY = 7.0, kLiToY = 11.0;  // section V.B: ([14, 7], [14, 11])

const std::vector<PrintedMover>& printed_movers() {
  static const std::vector<PrintedMover> all{{"li-complex", {kLiX, kLiFromY}, {kLiX, kLiToY}}};
  return all;
}

void place_others(Placing& placing, const Surprises& surprises, int movers) {
  for (int i = 0; i < movers; ++i) placing.place_mover((i + 1.0) / (movers + 1.0));
  for (int i = 0; i < surprises.hidden_boxes; ++i) placing.place_box((i + 0.4) / (surprises.hidden_boxes + 0.2));
}

}  // namespace

double nominal_speed_mps(double max_speed_mps) { return kNominalShare * max_speed_mps; }

Encounters encounters_on(const DrawnMap& map, const Surprises& surprises, double max_speed_mps) {
  if (!surprises.any()) return {};
  Placing placing(map, max_speed_mps);
  place_others(placing, surprises, surprises.movers);
  return placing.encounters();
}

Encounters encounters_of_paper(const std::string& name, const DrawnMap& map, const Surprises& surprises,
                               double max_speed_mps) {
  if (!surprises.any()) return {};
  Placing placing(map, max_speed_mps);
  int movers = surprises.movers;
  for (const PrintedMover& printed : printed_movers()) {
    if (name != printed.map || movers == 0) continue;
    placing.place_mover(printed.from_in_map, printed.to_in_map);
    --movers;
  }
  place_others(placing, surprises, movers);
  return placing.encounters();
}

void add(const Encounters& encounters, scenario::Scenario& scenario) {
  scenario.movers.insert(scenario.movers.end(), encounters.movers.begin(), encounters.movers.end());
  scenario.blocks.insert(scenario.blocks.end(), encounters.boxes.begin(), encounters.boxes.end());
}

}  // namespace aisle::lab
