#include "tools/sim/swarm.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <deque>
#include <map>
#include <optional>
#include <set>

#include "common/grid/clearance.hpp"
#include "tools/sim/scenarios/building.hpp"

namespace aisle::sim {
namespace {

using geometry::Point2;
using geometry::Pose2;

constexpr double kRadiusM = 0.35;        // of the vehicles
constexpr double kRoomM = 0.55;          // from starts and goals to walls
constexpr double kApartM = 1.1;          // between starts, and between goals; a floor has room for more than all
constexpr int kGoals = 8;                // of each vehicle
constexpr double kAfterFaultsS = 240.0;  // for what is left to do
constexpr double kSignedOffAfterS = 60.0;
constexpr double kRestS = 2.0;  // after the last arrival, so that it is heard of

/// A dead body keeps the others this far from its middle: both bodies, what vehicles may stray, and the gap.
constexpr double kAroundDeadM = 0.35 + 0.25;

/// 24 x 16 m: racks of 5 x 1.2 m, aisles of `aisle_m` between them.
grid::OccupancyGrid racks(double aisle_m) {
  grid::OccupancyGrid grid = hall(24.0, 16.0, 0.1);
  for (double y = aisle_m + 0.2; y + 1.2 < 15.6 - aisle_m; y += aisle_m + 1.2)
    for (double x = 3.0; x + 5.0 < 22.0; x += 5.0 + aisle_m) block(grid, x, y, x + 5.0, y + 1.2);

  return grid;
}

/// 16 x 12 m with four pillars.
grid::OccupancyGrid pillars() {
  grid::OccupancyGrid grid = hall(16.0, 12.0, 0.1);
  for (const double x : {4.5, 10.5})
    for (const double y : {3.0, 8.0}) block(grid, x, y, x + 1.0, y + 1.0);

  return grid;
}

/// Vehicles that die at some moment of the plan; fewer than half of the fleet.
std::vector<Death> deaths(Dice& dice, int fleet, double until_s) {
  const int most = (fleet - 1) / 2;
  const int first = dice.below(fleet);

  std::vector<Death> all;
  for (int i = dice.below(most + 1); i > 0; --i) {
    Death death;
    death.vehicle = fmt::format("agv-{}", (first + i) % fleet + 1);
    death.at_s = 3.0 + dice.below(static_cast<int>(until_s) - 5);
    death.signed_off_after_s = kSignedOffAfterS;
    all.push_back(death);
  }

  return all;
}

/// Both planners end at one moment and come back one after the other.
void crash_both_planners(Dice& dice, FaultPlan& plan) {
  const double at_s = 3.0 + dice.below(50);
  double restart_after_s = 1.0 + dice.below(4);

  for (const char* name : {"global-planner", "global-planner-standby"}) {
    Crash crash;
    crash.at_s = at_s;
    crash.process = name;
    crash.restart_after_s = restart_after_s;
    plan.crashes.push_back(crash);
    restart_after_s += 0.5;
  }
}

bool is_dead(const SwarmCase& swarm, const std::string& agv_id) {
  return std::find(swarm.dead.begin(), swarm.dead.end(), agv_id) != swarm.dead.end();
}

/// Cells that a living vehicle at `from` comes to, when the dead stand where they stand. By a flood over the neighbours
/// of each cell.
std::vector<bool> reachable(const SwarmCase& swarm, const std::vector<Pose2>& vehicles_in_map, Point2 from) {
  const grid::ClearanceField clearance(swarm.setup.grid, 2.0);
  const grid::Geometry& geometry = clearance.geometry();

  const auto is_free = [&](grid::Cell cell) {
    if (!geometry.contains(cell) || !clearance.is_traversable(cell, kRadiusM)) return false;

    for (std::size_t i = 0; i < swarm.setup.scenario.vehicles.size(); ++i) {
      const double apart_m = geometry::distance(vehicles_in_map[i].position(), geometry.center_in_map(cell));
      if (is_dead(swarm, swarm.setup.scenario.vehicles[i].id) && apart_m < kRadiusM + kAroundDeadM) return false;
    }

    return true;
  };

  std::vector<bool> seen(static_cast<std::size_t>(geometry.width) * static_cast<std::size_t>(geometry.height));
  std::deque<grid::Cell> open{geometry.cell_at(from)};

  while (!open.empty()) {
    const grid::Cell cell = open.front();
    open.pop_front();

    for (const grid::Cell next : {grid::Cell{cell.x + 1, cell.y}, grid::Cell{cell.x - 1, cell.y},
                                  grid::Cell{cell.x, cell.y + 1}, grid::Cell{cell.x, cell.y - 1}}) {
      if (!is_free(next) || seen[geometry.index(next)]) continue;
      seen[geometry.index(next)] = true;
      open.push_back(next);
    }
  }

  return seen;
}

/// Looks on during the run: who has arrived at its last goal, and when the traffic moved again.
class Onlooker {
 public:
  explicit Onlooker(const SwarmCase& swarm)
      : swarm_(swarm),
        is_on_last_(swarm.setup.scenario.vehicles.size(), false),
        is_done_(swarm.setup.scenario.vehicles.size(), false) {
    for (std::size_t i = 0; i < is_done_.size(); ++i) is_done_[i] = is_dead(swarm, id_of(i));
  }

  void look(const Snapshot& now) {
    now_s_ = now.t_s;
    vehicles_in_map_ = now.vehicles_in_map;
    note_arrivals(now);
    if (now.t_s < swarm_.last_fault_s) return;

    if (!at_last_fault_) {
      at_last_fault_ = now.vehicles_in_map;
      was_over_ = all_done();
    }

    for (std::size_t i = 0; i < is_done_.size() && !moves_again_s_; ++i)
      if (!is_done_[i] && has_moved(i, now)) moves_again_s_ = now.t_s;
  }

  /// All goals are reached, and it has been told.
  bool is_over() const { return done_since_s_ && now_s_ > *done_since_s_ + kRestS; }

  /// None where all was over by then.
  std::optional<double> stood_s() const {
    if (was_over_ || !at_last_fault_) return std::nullopt;
    return moves_again_s_.value_or(now_s_) - swarm_.last_fault_s;
  }

  /// When it last looked, in the scenario's order.
  const std::vector<Pose2>& vehicles_in_map() const { return vehicles_in_map_; }

 private:
  const std::string& id_of(std::size_t i) const { return swarm_.setup.scenario.vehicles[i].id; }

  bool all_done() const {
    return std::all_of(is_done_.begin(), is_done_.end(), [](bool done) { return done; });
  }

  void note_arrivals(const Snapshot& now) {
    for (std::size_t i = 0; i < is_done_.size(); ++i) {
      const bool is_last =
          now.plans[i] != nullptr && now.plans[i]->goal_id == fmt::format("{}/{}", id_of(i), kGoals - 1);
      if (!is_last) continue;

      // Its newest word may still be of the goal before.
      if (now.outputs[i].phase != fleet::Phase::kArrived)
        is_on_last_[i] = true;
      else if (is_on_last_[i])
        is_done_[i] = true;
    }

    if (all_done() && !done_since_s_) done_since_s_ = now.t_s;
  }

  bool has_moved(std::size_t i, const Snapshot& now) const {
    constexpr double kMovedM = 0.05;
    constexpr double kTurnedRad = 0.1;
    const Pose2 before = (*at_last_fault_)[i];
    const Pose2 after = now.vehicles_in_map[i];

    return geometry::distance(before.position(), after.position()) > kMovedM ||
           std::abs(geometry::wrap(after.yaw - before.yaw)) > kTurnedRad;
  }

  const SwarmCase& swarm_;
  std::vector<bool> is_on_last_;  // on the way to its last goal
  std::vector<bool> is_done_;     // arrived there, or dead
  std::optional<double> done_since_s_;
  std::optional<std::vector<Pose2>> at_last_fault_;
  bool was_over_{false};
  std::optional<double> moves_again_s_;
  double now_s_{0.0};
  std::vector<Pose2> vehicles_in_map_;
};

/// Counts the goals of the living, and names those that are lost.
void judge_goals(const SwarmCase& swarm, const std::vector<Pose2>& vehicles_in_map, SwarmVerdict& verdict) {
  std::set<std::string> reached;
  std::map<std::string, std::string> why_not;
  for (const referee::GoalRecord& goal : verdict.outcome.report.goals) {
    why_not[goal.goal_id] = goal.reason;
    if (goal.outcome == referee::GoalOutcome::kReached) reached.insert(goal.goal_id);
  }

  for (std::size_t i = 0; i < swarm.setup.scenario.vehicles.size(); ++i) {
    const std::string& agv_id = swarm.setup.scenario.vehicles[i].id;
    if (is_dead(swarm, agv_id)) continue;

    std::vector<bool> is_reachable;
    bool waits_for_good = false;  // for a goal that is closed off: it is given no later one
    for (int k = 0; k < kGoals; ++k) {
      const std::string goal_id = fmt::format("{}/{}", agv_id, k);
      ++verdict.goals;
      if (reached.count(goal_id) > 0) {
        ++verdict.reached;
        continue;
      }

      if (is_reachable.empty()) is_reachable = reachable(swarm, vehicles_in_map, vehicles_in_map[i].position());

      const Point2 goal = swarm.setup.scenario.missions[i].goals_in_map[static_cast<std::size_t>(k)].position();
      const grid::Geometry& geometry = swarm.setup.grid.geometry();
      waits_for_good = waits_for_good || !is_reachable[geometry.index(geometry.cell_at(goal))];
      if (!waits_for_good)
        verdict.failures.push_back(goal_id + " is not reached: " + why_not[goal_id]);
      else
        ++verdict.closed_off;
    }
  }
}

}  // namespace

SwarmCase swarm_case(std::uint64_t seed) {
  Dice dice(seed);
  SwarmCase swarm;

  // Floor and fleet.
  Setup& setup = swarm.setup;
  const int floor = dice.below(3);
  setup.grid = floor == 0 ? pillars() : racks(floor == 1 ? 2.4 : 1.6);

  const int fleet = 3 + dice.below(3);
  add_fleet(setup, dice, fleet, kGoals, kRadiusM, kRoomM, kApartM);
  setup.scenario.name = "swarm";
  setup.seed = seed;
  setup.has_standby_planner = true;

  // Faults.
  swarm.plan = random_fault_plan(seed);
  if (dice.below(4) == 0) crash_both_planners(dice, swarm.plan);
  swarm.plan.deaths = deaths(dice, fleet, swarm.plan.stop_s);

  swarm.last_fault_s = swarm.plan.stop_s;
  for (const Death& death : swarm.plan.deaths) {
    swarm.dead.push_back(death.vehicle);
    swarm.last_fault_s = std::max(swarm.last_fault_s, death.at_s + death.signed_off_after_s);
  }
  setup.scenario.duration_s = swarm.last_fault_s + kAfterFaultsS;

  return swarm;
}

SwarmVerdict drive_swarm_case(const SwarmCase& swarm, const Hooks& caller) {
  Onlooker onlooker(swarm);
  Hooks hooks;
  hooks.watch = [&](const Snapshot& now) { onlooker.look(now); };
  hooks.says = caller.says;

  bool is_stopped = false;
  hooks.goes_on = [&](double t_s) {
    is_stopped = is_stopped || (caller.goes_on && !caller.goes_on(t_s));
    return !is_stopped && !onlooker.is_over();
  };

  SwarmVerdict verdict;
  verdict.outcome = drive(swarm.setup, {swarm.plan, swarm.setup.seed}, hooks);
  if (is_stopped) return verdict;

  // Contacts, floor and authority are the referee's.
  for (const referee::Contact& contact : verdict.outcome.report.contacts)
    if (contact.vehicle_moved())
      verdict.failures.push_back(fmt::format("{:.1f} s {} touches {}", contact.begin_s, contact.a, contact.b));
  for (const referee::AuthorityViolation& violation : verdict.outcome.report.violations)
    verdict.failures.push_back(fmt::format("{:.1f} s {}: {}", violation.t_s, violation.agv_id, violation.text));

  judge_goals(swarm, onlooker.vehicles_in_map(), verdict);

  // Where what is left is closed off, nobody has to move.
  const bool has_more_to_do = verdict.reached + verdict.closed_off < verdict.goals;
  verdict.stood_s = onlooker.stood_s().value_or(0.0);
  if (verdict.stood_s > kMovesAgainS && (has_more_to_do || verdict.closed_off == 0))
    verdict.failures.push_back(fmt::format("no vehicle moved for {:.1f} s after the last fault", verdict.stood_s));

  return verdict;
}

}  // namespace aisle::sim
