#include "services/local-planner/core/road.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "common/kinematics/vehicle_model.hpp"
#include "services/local-planner/core/tube.hpp"

namespace aisle::local_planner {
namespace {

using geometry::Point2;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kRoundingM = 1e-6;
constexpr double kSamePointM = 0.01;  // a turn and a step's end so near to each other are one

// Where the vehicle is looked for on its plan.
constexpr double kAheadM = 1.5;        // of where it was, on the free floor,
constexpr double kAheadInTubeM = 0.6;  // and in a tube
constexpr double kBesideM = 0.15;      // a new plan leads past so near by, or the vehicle is looked for all along it,
constexpr double kFirstPartsM[] = {0.3, 1.0, 3.0};  // after these first parts of it
constexpr double kNearByM = 0.5;                    // a plan that repeats where the vehicle is leads past so near by
constexpr double kSamePlaceM = 0.3;  // on a plan that repeats the part of the one before where the vehicle is

// Steps.
constexpr double kThereShare =
    0.8;  // of the tube: so near to the end of a step it is done, and to a turn the vehicle is there
constexpr double kThereM = 0.05;    // the same on the free floor
constexpr double kReactionS = 0.3;  // from a grant's arrival to when the vehicle brakes
constexpr double kStandsMps = 0.02;
constexpr std::size_t kMostHeld = 32;

// Turns.
constexpr double kArcM = 0.5;  // from an arc's begin to its turn, at most
constexpr double kLeastArcM = 0.1;
constexpr double kLegShare = 0.5;     // of the shorter leg
constexpr double kTooSharpRad = 1.7;  // a sharper turn is made on the spot
constexpr double kNoTurnRad = 0.01;
constexpr double kCutRad = 0.6;       // a turn without an arc, up to this, is cut by a few centimetres as it is driven
constexpr double kBeforeArcM = 0.05;  // ahead of the vehicle an arc may begin
constexpr double kWallShare = 0.5;    // of the lane's margin: arcs come so near to walls

}  // namespace

void Road::follow(const Moment& moment, double speed_mps) {
  const std::optional<Plan>& plan = moment.inputs.plan;
  const bool leads_somewhere = plan && plan->is_found() && !plan->waypoints_in_map.empty();
  bool is_changed = false;

  if (leads_somewhere) {
    const bool is_other = plan->id != plan_id_ || plan->waypoints_in_map != waypoints_in_map_ ||
                          plan->step_ends_m != step_ends_m_ || plan->first_step != first_step_ ||
                          plan->tube_m != tube_m_;
    if (is_other) take(*plan, moment.here());

    const std::optional<Grant>& grant = moment.inputs.grant;
    const bool is_new_grant = grant && has_steps() && (is_other || grant->number != grant_number_);
    if (is_new_grant) obey(*grant);
    if (is_other && has_steps() && progress_m_ > limit_m())
      progress_m_ = way_.project(moment.here(), 0.0, limit_m());  // it is on what is granted, wherever else it comes by
    is_changed = is_other || is_new_grant;
  }

  if (!has_steps()) return;
  move_on(moment);
  is_changed = give_back(speed_mps) || is_changed;
  is_changed = take_more() || is_changed;
  if (is_changed && tube_m_ > 0.0 && moment.inputs.clearance != nullptr) round_turns(moment);
}

/// Another plan: the vehicle is on it where it was on the one before, if it repeats that part; else where it is.
void Road::take(const Plan& plan, Point2 here_in_map) {
  Route way(plan.waypoints_in_map);
  progress_m_ = progress_on(plan, way, here_in_map);

  plan_id_ = plan.id;
  waypoints_in_map_ = plan.waypoints_in_map;
  way_ = std::move(way);
  first_step_ = plan.first_step;
  step_ends_m_ = plan.step_ends_m;
  tube_m_ = plan.tube_m;
  ends_at_goal_ =
      geometry::distance(plan.waypoints_in_map.back(), plan.goal_in_map.position()) <= plan.position_tolerance_m;

  // Steps that the vehicle has done are not done again; numbers that begin anew are another registration.
  const auto is_of_plan = [&](std::uint64_t step) { return step >= first_step_ && step <= end_step(); };
  if (!is_of_plan(step_done_)) step_done_ = first_step_;
  if (!is_of_plan(limit_step_)) limit_step_ = first_step_;
  granted_step_ = wanted_limit_step_ = limit_step_;
  progress_m_ = std::max(progress_m_, end_of_steps_below_m(step_done_));  // the way may turn back there

  find_turns();
  ++lane_revision_;
}

double Road::progress_on(const Plan& plan, const Route& way, Point2 here_in_map) const {
  // The step that the vehicle is on, by its number, and what is left of it.
  const auto on = std::upper_bound(step_ends_m_.begin(), step_ends_m_.end(), progress_m_);
  if (on != step_ends_m_.end()) {
    const std::uint64_t step = first_step_ + static_cast<std::uint64_t>(std::distance(step_ends_m_.begin(), on));
    if (step >= plan.first_step && step < plan.first_step + plan.step_ends_m.size()) {
      const double about_m = plan.step_ends_m[step - plan.first_step] - (*on - progress_m_);
      const double there_m = way.project(here_in_map, about_m - kSamePlaceM, about_m + kSamePlaceM);
      if (geometry::distance(way.at(there_m), here_in_map) < kNearByM) return there_m;
    }
  }

  // Near its beginning if that is where the vehicle is: the way may come by here again.
  for (const double first_part_m : kFirstPartsM) {
    const double there_m = way.project(here_in_map, 0.0, first_part_m);
    if (geometry::distance(way.at(there_m), here_in_map) < kBesideM) return there_m;
  }

  return way.project(here_in_map, 0.0, way.length_m());
}

/// Turning points and ends of steps, in the order of the way. Arcs that were begun on the plan before are kept.
void Road::find_turns() {
  const std::vector<Turn> before = std::move(turns_);
  turns_.clear();

  // Both lists, merged by how far along they lie.
  const std::vector<Point2>& points = way_.points();
  std::size_t i = 0, k = 0;
  while (i < points.size() || k < step_ends_m_.size()) {
    const double point_m = i < points.size() ? way_.along_m(i) : kInfinity;
    const double end_m = k < step_ends_m_.size() ? std::min(step_ends_m_[k], way_.length_m()) : kInfinity;
    Turn turn;
    turn.at_m = std::min(point_m, end_m);
    turn.step = first_step_ + k;
    turn.in_map = point_m <= end_m + kSamePointM ? points[i] : way_.at(end_m);
    if (point_m <= turn.at_m + kSamePointM) ++i;
    if (end_m <= turn.at_m + kSamePointM) ++k;
    turns_.push_back(turn);
  }

  // How sharply they turn, and what there is beside them.
  for (std::size_t j = 1; j + 1 < turns_.size(); ++j) {
    Turn& turn = turns_[j];
    const Turn &last = turns_[j - 1], &next = turns_[j + 1];
    turn.leg_m = std::min(turn.at_m - last.at_m, next.at_m - turn.at_m);
    turn.by_rad = std::abs(
        geometry::wrap(geometry::bearing(turn.in_map, next.in_map) - geometry::bearing(last.in_map, turn.in_map)));
    for (const Turn& known : before)
      if (geometry::distance(known.in_map, turn.in_map) < kSamePointM &&
          std::abs(known.by_rad - turn.by_rad) < kNoTurnRad && turn.at_m - known.arc_m <= progress_m_) {
        turn.arc_m = std::min(known.arc_m, kLegShare * turn.leg_m);
        turn.was_reached = known.was_reached;
      }
  }
}

/// More is taken at once, as far as it can be told; less only as the vehicle can stop (see give_back).
void Road::obey(const Grant& grant) {
  granted_step_ = std::clamp(grant.limit_step, first_step_, end_step());
  wanted_limit_step_ = most_told(granted_step_);
  limit_step_ = std::max(limit_step_, wanted_limit_step_);
  grant_number_ = grant.number;
}

/// Takes what is granted and could not be told before. @returns whether there was any
bool Road::take_more() {
  if (granted_step_ <= wanted_limit_step_) return false;

  const std::uint64_t before = wanted_limit_step_;
  wanted_limit_step_ = std::max(before, most_told(granted_step_));
  limit_step_ = std::max(limit_step_, wanted_limit_step_);
  return wanted_limit_step_ > before;
}

/// Lowers the limit towards what is wanted, as low as the vehicle can stop at now. @returns whether it did
bool Road::give_back(double speed_mps) {
  if (limit_step_ <= wanted_limit_step_) return false;

  const std::uint64_t before = limit_step_;
  limit_step_ = std::max(wanted_limit_step_, std::min(limit_step_, lowest_limit(speed_mps)));
  return limit_step_ < before;
}

/// Where the vehicle is on its plan now, never back and never beyond its limit; and which steps it has done.
void Road::move_on(const Moment& moment) {
  const Point2 here = moment.here();
  const std::size_t gate = next_gate();
  const bool is_at_gate = gate < turns_.size() && turns_[gate].at_m - progress_m_ < kAheadInTubeM &&
                          geometry::distance(here, turns_[gate].in_map) < kThereShare * tube_m_;
  if (is_at_gate) turns_[gate].was_reached = true;

  const double ahead_m = tube_m_ > 0.0 ? kAheadInTubeM : kAheadM;
  const double most_m = std::min({progress_m_ + ahead_m, gate_m(), std::max(progress_m_, limit_m())});
  progress_m_ = std::max(progress_m_, way_.project(here, progress_m_, most_m));

  while (step_done_ < limit_step_ &&
         (end_of_steps_below_m(step_done_ + 1) <= progress_m_ + kRoundingM || stands_at_end_of(step_done_, moment)))
    ++step_done_;
}

/// Is the vehicle so near to where the step ends that it is inside what the next one holds?
bool Road::stands_at_end_of(std::uint64_t step, const Moment& moment) const {
  const double end_m = end_of_steps_below_m(step + 1);
  if (end_m - progress_m_ > kAheadInTubeM) return false;

  const double there_m = tube_m_ > 0.0 ? kThereShare * tube_m_ : kThereM;
  const std::vector<Point2> end{way_.at(std::max(0.0, end_m - kSamePointM)), way_.at(end_m)};

  return off_path_m(end, moment.motion.base_now, moment.discs.ahead_m, moment.vehicle.turns_on_the_spot()) <= there_m;
}

/// The arc of each turn that is ahead: none where the road is not granted beyond it.
void Road::round_turns(const Moment& moment) {
  for (Turn& turn : turns_) {
    const bool is_begun = turn.at_m - turn.arc_m <= progress_m_;
    if (is_begun) continue;

    const double arc_m = arc_at(turn, moment);
    if (arc_m == turn.arc_m) continue;
    turn.arc_m = arc_m;
    ++lane_revision_;
  }
}

double Road::arc_at(const Turn& turn, const Moment& moment) const {
  const bool is_granted = limit_m() > turn.at_m + kRoundingM;
  const bool is_a_turn = turn.by_rad > kNoTurnRad && turn.by_rad < kTooSharpRad;
  if (!is_granted || !is_a_turn || !moment.vehicle.turns_on_the_spot()) return 0.0;

  // Half of the shorter leg, and what is left to drive before it.
  double arc_m = std::min({kArcM, kLegShare * turn.leg_m, turn.at_m - progress_m_ - kBeforeArcM});

  // The arc's middle is where it may come near to a wall.
  const grid::ClearanceField& clearance = *moment.inputs.clearance;
  const double needed_m =
      std::min(clearance.clearance_m(turn.in_map), moment.way_radius_m() + kWallShare * lane_settings_.margin_m);
  const Point2 before = way_.at(turn.at_m - kLegShare * turn.leg_m);
  const Point2 after = way_.at(turn.at_m + kLegShare * turn.leg_m);
  const Point2 inwards = 0.5 * (before + after) - turn.in_map;
  const auto middle = [&] {
    return turn.in_map + (arc_off_turn_m(arc_m, turn.by_rad) / geometry::norm(inwards)) * inwards;
  };
  while (arc_m >= kLeastArcM && clearance.clearance_m(middle()) < needed_m) arc_m *= kLegShare;

  return arc_m >= kLeastArcM ? arc_m : 0.0;
}

Lane Road::lane() const {
  std::vector<RoundedTurn> rounded;
  for (const Turn& turn : turns_) rounded.push_back({turn.in_map, turn.arc_m});

  return rounded_lane(rounded);
}

double Road::end_of_steps_below_m(std::uint64_t step) const {
  if (step <= first_step_ || !has_steps()) return 0.0;

  return step_ends_m_[std::min<std::size_t>(step - first_step_, step_ends_m_.size()) - 1];
}

double Road::stop_at_m() const {
  const bool stops_at_once = has_steps() && wanted_limit_step_ <= step_done_ && wanted_limit_step_ < limit_step_;
  if (stops_at_once && !is_on_arc_into_next_step()) return progress_m_;

  const bool is_at_goal = limit_step_ >= end_step() && ends_at_goal_;
  return !has_steps() || is_at_goal ? kInfinity : limit_m();
}

double Road::gate_m() const {
  const std::size_t gate = next_gate();
  return gate < turns_.size() ? turns_[gate].at_m : kInfinity;
}

std::size_t Road::next_gate() const {
  if (tube_m() <= 0.0) return turns_.size();

  for (std::size_t i = 1; i + 1 < turns_.size(); ++i) {
    const Turn& turn = turns_[i];
    const bool is_gate = turn.arc_m == 0.0 && turn.by_rad > kCutRad;
    if (is_gate && !turn.was_reached && turn.at_m >= progress_m_ - kRoundingM) return i;
  }

  return turns_.size();
}

/// The first number of a step that need not be driven: the vehicle stands in the one before, or can stop in comfort at
/// its end; and it has not begun the arc into that step. A vehicle that stands in a step need not drive the rest of it.
std::uint64_t Road::lowest_limit(double speed_mps) const {
  const bool stands = speed_mps < kStandsMps;
  const double stop_m =
      progress_m_ + (stands ? 0.0 : kinematics::stopping_distance_m(speed_mps, comfort_mps2_) + kReactionS * speed_mps);
  const bool is_on_arc = is_on_arc_into_next_step();
  const bool is_asked_for_all = wanted_limit_step_ <= step_done_;  // then its place is all that is held for it
  if (stands && (!is_on_arc || is_asked_for_all)) return step_done_;

  for (std::uint64_t step = step_done_ + (is_on_arc ? 1 : 0); step < end_step(); ++step)
    if (stop_m <= end_of_steps_below_m(step + 1)) return step + 1;

  return end_step();
}

/// Has it begun the arc at the end of the step that it is on? That floor belongs to the next one.
bool Road::is_on_arc_into_next_step() const {
  const double end_m = end_of_steps_below_m(step_done_ + 1);
  return std::any_of(turns_.begin(), turns_.end(), [&](const Turn& turn) {
    return turn.arc_m > 0.0 && std::abs(turn.at_m - end_m) < kSamePointM && turn.at_m - turn.arc_m <= progress_m_;
  });
}

/// The limit, or a lower one so that all poses up to it can be told.
std::uint64_t Road::most_told(std::uint64_t limit_step) const {
  const auto ahead = [&](std::uint64_t step) {
    const double end_m = end_of_steps_below_m(step);
    return static_cast<std::size_t>(std::count_if(turns_.begin(), turns_.end(), [&](const Turn& turn) {
      return turn.at_m > progress_m_ && turn.at_m <= end_m + kSamePointM;
    }));
  };
  while (limit_step > first_step_ && ahead(limit_step) >= kMostHeld) --limit_step;

  return limit_step;
}

std::vector<HeldPose> Road::held(const Moment& moment) const {
  std::vector<HeldPose> poses{{moment.motion.base_now, step_done_}};
  const double end_m = limit_m();

  for (const Turn& turn : turns_) {
    if (turn.at_m <= progress_m_ || turn.at_m > end_m + kSamePointM || poses.size() >= kMostHeld) continue;
    poses.push_back(
        {{turn.in_map.x, turn.in_map.y, way_.heading_at(turn.at_m - kSamePointM)}, std::max(step_done_, turn.step)});
  }

  return poses;
}

RoadReport Road::report(const Moment& moment) const {
  RoadReport report;
  if (!has_steps()) return report;

  report.progress_m = progress_m_;
  report.step_done = step_done_;
  report.limit_m = limit_m();
  report.limit_step = limit_step_;
  report.grant_number = grant_number_;
  report.held = held(moment);

  return report;
}

}  // namespace aisle::local_planner
